"""Modules with the names, arguments and results of other packages, computed by powercell."""
