"""Serves a navigator of a file as a process: serve.py FILE CLASS. rockyard.as_process() makes the command."""

import importlib.util
import sys
from pathlib import Path


def main() -> None:
    """Serves the navigator that the command line names."""
    file, name = Path(sys.argv[1]), sys.argv[2]
    sys.path[0] = str(file.parent)  # in place of the package's own folder, whose modules have plain names
    sys.path.append(str(Path(__file__).resolve().parent.parent))
    spec = importlib.util.spec_from_file_location(file.stem, file)
    if spec is None or spec.loader is None:
        sys.exit(f"{file} is no module of Python")
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    spec.loader.exec_module(module)
    from rockyard import navigator

    navigator.run(getattr(module, name))


if __name__ == "__main__":
    main()
