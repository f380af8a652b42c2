#!/usr/bin/python3
"""Draws a published figure anew from run folders.

    scripts/studies/figures/figures.py --list
    scripts/studies/figures/figures.py matthies1995-17 results/runs/quickstart/nominal --out figures

Writes FIGURE.svg and FIGURE.png, and FIGURE.txt with what the picture shows. The same runs give the
same bytes. Needs Debian's matplotlib: scripts/install_dependencies.sh figures (this is why the first
line asks for Debian's own Python).
"""

import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path[0] = str(ROOT / "scripts/studies")
import study  # noqa: E402

try:
    import figures
    from figures import source as figure_source
    from figures import style
except ImportError as missing:
    sys.exit(f"figures: {missing}; install Debian's matplotlib with "
             "scripts/install_dependencies.sh figures, and call this with /usr/bin/python3")


def parser():
    result = study.argument_parser(__doc__)
    result.add_argument("figure", nargs="?", metavar="FIGURE", help="a name of --list")
    result.add_argument("runs", nargs="*", metavar="RUN", help="run folders, or what else --list says")
    result.add_argument("--list", action="store_true", help="the figures, and the runs that each needs")
    result.add_argument("--out", type=Path, default=Path("."), metavar="FOLDER",
                        help="where the files go (default: here)")
    result.add_argument("--page", type=Path, help="write the caption between the marks of the figure on this page")
    result.add_argument("--name", help="of the files (default: the figure's)")
    result.add_argument("--format", choices=style.FORMATS, help="of the picture (default: both)")
    result.add_argument("--trial", type=int,
                        help="for figures of one trial (default: 0; of figure 16 the first one like the published)")
    result.add_argument("--step", type=int, default=0,
                        help="for figures of one decision of a navigator (default: 0)")
    result.add_argument("--fields", type=int, default=100,
                        help="terrains that are counted for figures of rock sizes (default: 100)")
    result.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard",
                        help="the command (default: build/release/bin/rockyard)")
    return result


def listing(known):
    width = max(len(name) for name in known)
    return "\n".join(f"{name:<{width}}  {figure.title}\n{'':<{width}}  RUN: {figure.runs}"
                     for name, figure in known.items())


def find(known, name):
    if name is None:
        raise figures.FigureError("no figure is named: see --list")
    if name not in known:
        raise figures.FigureError(f"{name}: is no figure; one of {', '.join(known)}")
    return known[name]


def check_count(figure, runs):
    fewest, most = figure.accepts
    if not fewest <= len(runs) <= most:
        wanted = str(fewest) if fewest == most else f"{fewest} to {most}"
        raise figures.FigureError(f"{figure.name} needs {wanted} RUN, and {len(runs)} were given "
                                  f"({figure.runs})")


def check_numbers(options):
    for name, least in (("trial", 0), ("step", 0), ("fields", 1)):
        if (getattr(options, name) or least) < least:
            raise figures.FigureError(f"--{name}: must be at least {least}")


def make(options, known):
    figure = find(known, options.figure)
    runs = options.runs or [ROOT / path for path in figure.defaults]
    check_count(figure, runs)
    check_numbers(options)
    sources = [figure_source.Source(run, options.rockyard) for run in runs]
    if options.trial is None:
        options.trial = figure.chosen(sources[0]) if sources else 0
    drawn = figure.draw(sources, options)
    options.out.mkdir(parents=True, exist_ok=True)
    name = options.name or figure.name
    formats = (options.format,) if options.format else style.FORMATS
    paths = style.save(drawn.figure, options.out, name, formats)
    text = options.page or options.out / f"{name}.txt"
    if options.page:
        study.write_table([options.page], figure.name, textwrap.fill(drawn.caption, 118, break_on_hyphens=False))
    else:
        text.write_text(drawn.caption + "\n", encoding="utf-8")
    print("\n".join(str(path) for path in (*paths, text)))


def main():
    options = parser().parse_args()
    known = figures.all_figures()
    try:
        if options.list:
            print(listing(known))
        else:
            make(options, known)
    except (figures.FigureError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
