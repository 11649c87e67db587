#!/usr/bin/env python3
"""Draws the spectra that `powercell sample --periodic --analysis FILE.json` wrote.

usage: sampling_plot.py FILE.json PICTURE.png [TITLE]
"""
import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def main():
    analysis, picture = sys.argv[1], sys.argv[2]
    with open(analysis) as file:
        data = json.load(file)
    if "spectrum" not in data:
        sys.exit(f"{analysis}: no spectrum; it needs --periodic")
    spectrum = data["spectrum"]
    highest, points, runs = spectrum["highest"], spectrum["points"], spectrum["runs"]
    power = np.array(spectrum["power"]).reshape(2 * highest + 1, -1)
    power[highest, highest] = 0  # the mean density
    frequency = np.arange(1, highest + 1) / math.sqrt(points)
    mean = data["mean"]

    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), constrained_layout=True)
    extent = np.array([-1, 1, -1, 1]) * highest / math.sqrt(points)
    axes[0].imshow(np.sqrt(power), cmap="gray", origin="lower", extent=extent, vmax=2.2)
    axes[0].set(title="power spectrum (square root)", xlabel="frequency / √n")
    axes[1].plot(frequency, spectrum["radial_mean"], color="#1d2b3a")
    axes[1].axhline(1, color="gray", linewidth=0.7, linestyle=":")
    axes[1].set(title="radial mean of the power", xlabel="frequency / √n", ylim=(0, None), xlim=(0, 2))
    axes[2].plot(frequency, spectrum["anisotropy_db"], color="#1d2b3a")
    axes[2].axhline(-10 * math.log10(runs), color="gray", linewidth=0.7, linestyle=":")
    axes[2].set(title="anisotropy (dB); dotted: isotropic", xlabel="frequency / √n", ylim=(-20, 10), xlim=(0, 2))
    title = sys.argv[3] if len(sys.argv) > 3 else ""
    figure.suptitle(f"{title}{points} points, mean of {runs} runs: distances least {mean['least_distance']:.3f} "
                    f"mean {mean['mean_distance']:.3f}, ψ6 {mean['hexatic']:.3f}, "
                    f"E/E_hex {mean['relative_energy']:.4f}")
    figure.savefig(picture, dpi=80)


if __name__ == "__main__":
    main()
