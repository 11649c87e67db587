"""Configuration of the documentation site. docs/site/build.sh sets the variables and calls Sphinx."""

import os
import pathlib

import powercell

project = "powercell"
author = "the powercell authors"
project_copyright = author
version = release = powercell.__version__

extensions = [
    "breathe",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
]
root_doc = "index"

myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
highlight_language = "none"
suppress_warnings = [
    "duplicate_declaration.c",  # OpenCL's handles, which two headers declare
    "duplicate_declaration.cpp",  # the namespace, of which each header is a part
]

breathe_projects = {"powercell": os.environ["POWERCELL_DOXYGEN"]}
breathe_default_project = "powercell"
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}
breathe_default_members = ("members", "undoc-members")
breathe_show_include = False
cpp_id_attributes = ["POWERCELL_API"]
c_id_attributes = ["POWERCELL_API"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say types and shapes
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True  # attributes of the docstring, and not again as members

html_theme = "furo"
html_title = f"powercell {release}"
html_search_scorer = str(pathlib.Path(__file__).with_name("search.js"))
html_static_path = ["_static"]
html_css_files = ["style.css"]
html_extra_path = ["extra"]  # pictures of raw HTML, at the paths that it names
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f5f8b", "color-brand-content": "#1f5f8b"},
    "dark_css_variables": {"color-brand-primary": "#7fb8de", "color-brand-content": "#7fb8de"},
    "top_of_page_buttons": [],
}
copybutton_exclude = ".linenos, .gp, .go"
