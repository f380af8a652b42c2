#!/usr/bin/env python3
"""Compares rendered soil with real images of Mars, and prints the tables of src/rendering/README.md.

Of square parts of ground without shadows of the rover: the logarithmic slope of the power spectrum
over rings of frequency, from 1/64 to 1/4 cycle a pixel, and the moments of the histogram: deviation
over mean ("contrast"), also of what varies over less than 16 pixels, and skewness. Moments are taken
of images in proportion to radiance only, the Navcam's; press images of the Pancam are stretched, so
that they give slopes, and the density of disparities.

    scripts/studies/texture/texture.py --data DIR [--pictures build/test/tests/rendering/soil_pictures]
                             [--rockyard build/test/bin/rockyard]

DIR holds msl_navcam_image and mars_pancam_stereo_pair. With --rockyard, stereo is run on the real
pair, its rows aligned, and on rendered pairs.
"""

import sys
import tempfile
from pathlib import Path

import matplotlib.image
import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SIDE = 128
NAVCAM = "msl_navcam_image/NRB_701383954RAS_F0933408NCAM00200M1.IMG"
PANCAM = "mars_pancam_stereo_pair"
# Label of 24 records of 2048 bytes (SOURCE.txt), then 1024 x 1024 numbers of 16 bits.
NAVCAM_OFFSET = 24 * 2048
# Upper left corners (row, column) of the parts.
NAVCAM_PARTS = {"Navcam, gravel 1": (110, 300), "Navcam, gravel 2": (880, 480), "Navcam, gravel 3": (600, 130)}
PANCAM_PARTS = {"Pancam, drift 1": (580, 200), "Pancam, drift 2": (640, 330),
                "Pancam, dark drift": (880, 330), "Pancam, pebbles": (170, 430)}
GRAININESS = (0.0, 0.25, 0.5, 0.75, 1.0)
# Sun, rocks, camera of the rendered pictures: the Navcam's pixels and the sun of its image (7.8
# degrees, its label), and those of a higher sun; rocks of the law beside none.
LOOKS = {"sun at 8 degrees": (8, 0.0), "sun at 8 degrees, rocks": (8, 0.05), "sun at 40 degrees": (40, 0.0)}
CAMERA = (0.82, 512, 45, 1.9, 0.1)  # mrad, columns, pitch, height, baseline
# As the Pancam sees drift: disparities grow by a third of a pixel from row to row.
PAIR = (0.28, 900, 17, 1.5, 0.5)
PAIR_FIRST = 220


def read_navcam(path):
    data = path.read_bytes()
    return np.frombuffer(data, ">i2", 1024 * 1024, NAVCAM_OFFSET).reshape(1024, 1024).astype(float)


def read_pancam(path):
    pixels = matplotlib.image.imread(path)
    return pixels[..., :3] @ np.array([0.299, 0.587, 0.114])


def without_trend(part):
    """What is left of an image, over its mean, without the plane that fits it best."""
    rows, columns = np.mgrid[:part.shape[0], :part.shape[1]]
    base = np.stack([np.ones(part.size), rows.ravel(), columns.ravel()], axis=1)
    fit, *_ = np.linalg.lstsq(base, part.ravel(), rcond=None)
    return (part - (base @ fit).reshape(part.shape)) / part.mean()


def rings(part):
    """Mean power by ring of frequency, in cycles a pixel, equally wide in its logarithm."""
    window = np.outer(np.hanning(part.shape[0]), np.hanning(part.shape[1]))
    power = np.abs(np.fft.fft2(without_trend(part) * window)) ** 2
    down, right = np.meshgrid(*(np.fft.fftfreq(n) for n in part.shape), indexing="ij")
    frequency = np.hypot(down, right)
    edges = np.geomspace(1 / 64, 1 / 4, 9)
    middles, means = [], []
    for low, high in zip(edges, edges[1:]):
        inside = (frequency >= low) & (frequency < high)
        middles.append(np.exp(np.log(frequency[inside]).mean()))
        means.append(power[inside].mean())
    return np.array(middles), np.array(means)


def slope(part):
    """The exponent e of a power spectrum f^-e."""
    middles, means = rings(part)
    return -np.polyfit(np.log(middles), np.log(means), 1)[0]


def moments(part):
    """Contrast, that of what varies over less than 16 pixels, and skewness."""
    rest = without_trend(part)
    spectrum = np.fft.fft2(rest)
    down, right = np.meshgrid(*(np.fft.fftfreq(n) for n in part.shape), indexing="ij")
    spectrum[np.hypot(down, right) < 1 / 16] = 0
    fine = np.fft.ifft2(spectrum).real
    return rest.std(), fine.std(), (rest ** 3).mean() / rest.std() ** 3


def part_of(image, corner):
    row, column = corner
    return image[row:row + SIDE, column:column + SIDE]


def row_of(name, part, is_radiance):
    numbers = moments(part) if is_radiance else (None,) * 3
    cells = [f"{slope(part):.2f}"] + ["-" if x is None else f"{x:.3f}" for x in numbers[:2]]
    cells.append("-" if numbers[2] is None else f"{numbers[2]:+.2f}")
    return f"| {name} | " + " | ".join(cells) + " |"


def render(pictures, out, graininess, sun_deg, rocks, camera=CAMERA):
    study.run([pictures, out, graininess, sun_deg, rocks, *camera])


def matched(rockyard, left, right, folder, first, *options):
    """Which pixels of the left image have one of 240 disparities from the first on."""
    study.run([rockyard, "stereo", left, right, "--out", folder, "--param", f"correlator.min_disparity_px={first}",
               "--param", "correlator.disparities=240", *options])
    return np.isfinite(study.read_portable(Path(folder) / "disparity.pfm"))


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--pictures", type=Path, default=study.ROOT / "build/test/tests/rendering/soil_pictures")
    parser.add_argument("--rockyard", type=Path)
    options = parser.parse_args()
    print("| ground | slope | contrast | below 16 px | skew |\n|---|---|---|---|---|")
    navcam = read_navcam(options.data / NAVCAM)
    for name, corner in NAVCAM_PARTS.items():
        print(row_of(name, part_of(navcam, corner), True))
    pancam = read_pancam(options.data / PANCAM / "4l.png")
    for name, corner in PANCAM_PARTS.items():
        print(row_of(name, part_of(pancam, corner), False))
    with tempfile.TemporaryDirectory() as folder:
        for look, (sun_deg, rocks) in LOOKS.items():
            for graininess in GRAININESS:
                out = Path(folder) / f"{sun_deg}_{rocks}_{graininess}"
                render(options.pictures, out, graininess, sun_deg, rocks)
                image = study.read_portable(f"{out}_left.pfm")
                # The middle half, in quarters: four parts.
                parts = [part_of(image, corner) for corner in ((128, 128), (128, 256), (256, 128), (256, 256))]
                slopes = np.mean([slope(part) for part in parts])
                means = np.mean([moments(part) for part in parts], axis=0)
                print(f"| rendered, {graininess:g}, {look} | {slopes:.2f} | {means[0]:.3f} | "
                      f"{means[1]:.3f} | {means[2]:+.2f} |")
        if options.rockyard:
            print("\n| pair | pixels with a disparity |\n|---|---|")
            real = options.data / PANCAM
            seen = matched(options.rockyard, real / "4l.png", real / "4r.png", Path(folder) / "real", -120, "--align")
            print(f"| Pancam | {seen.mean():.2f} |")
            for name, corner in PANCAM_PARTS.items():
                print(f"| {name} | {part_of(seen, corner).mean():.2f} |")
            for graininess in GRAININESS:
                out = Path(folder) / f"pair_{graininess}"
                render(options.pictures, out, graininess, 40, 0.0, PAIR)
                seen = matched(options.rockyard, f"{out}_left.pgm", f"{out}_right.pgm",
                               Path(folder) / "rendered", PAIR_FIRST)
                # Columns whose ground the right eye sees, too.
                print(f"| rendered, {graininess:g} | {seen[:, PAIR[1] // 2:].mean():.2f} |")


if __name__ == "__main__":
    main()
