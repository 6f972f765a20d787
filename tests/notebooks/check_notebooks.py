#!/usr/bin/env python3
"""Executes notebooks and refuses those that do not do what a reader expects of them.

  check_notebooks.py [--figures DIR] [--refused TEXT] NOTEBOOK|FOLDER...

Each notebook must be committed without outputs, run from its folder without an error, and draw at
least one figure, none of them blank. --figures writes the figures as PNG files. --refused turns the
test around: every notebook must be refused, with TEXT in the reason. Exit status 77: Jupyter,
pandas or matplotlib is not there.
"""

import argparse
import base64
import importlib.util
import io
import os
import pathlib
import sys
import tempfile

try:
    import matplotlib.image
    import nbformat
    import pandas  # noqa: F401, the notebooks need it
    from nbclient.util import run_sync
    from nbconvert.preprocessors import CellExecutionError, ExecutePreprocessor
    from jupyter_client.kernelspec import NoSuchKernel
    from traitlets.config import Config
    import ipykernel  # noqa: F401
except ImportError as error:
    print(f"Skipped: {error}. Debian: python3-nbconvert python3-ipykernel python3-pandas "
          "python3-matplotlib")
    sys.exit(77)

os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # else every kernel warns about its debugger

HAS_HALFSTEP = importlib.util.find_spec("halfstep") is not None
LEAST_COLOUR = 0.002  # of a figure's pixels; the shipped figures have 0.008 and more


class Refused(Exception):
    pass


def colour(png):
    """Fraction of the pixels that are not grey: data, as axes, grid and text are grey or black."""
    pixels = matplotlib.image.imread(io.BytesIO(png))[..., :3]
    return float((pixels.max(axis=-1) - pixels.min(axis=-1) > 0.1).mean())


class Kernels:
    """Runs notebooks of one folder in one kernel, whose names are forgotten between them."""

    def __init__(self):
        # Sockets in a folder of ours: a port that is free when a kernel is told of it may be another
        # program's when the kernel opens it.
        config = Config({"KernelManager": {
            "transport": "ipc", "ip": os.environ["JUPYTER_RUNTIME_DIR"] + "/kernel"}})
        self.executor = ExecutePreprocessor(timeout=120, kernel_name="python3", config=config)
        self.manager, self.folder = None, None

    def run(self, notebook, folder):
        if self.folder != folder:
            self.close()
            self.manager, self.folder = self.executor.create_kernel_manager(), folder
        notebook.cells.insert(0, nbformat.v4.new_code_cell("%reset -f"))
        self.executor.preprocess(notebook, {"metadata": {"path": str(folder)}}, km=self.manager)

    def close(self):
        if self.manager is not None:
            run_sync(self.manager.shutdown_kernel)(now=True)
        self.manager = self.folder = None


def figures_of(path, kernels):
    """PNG files that a notebook draws, in their order."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    if any(cell.outputs or cell.execution_count for cell in cells):
        raise Refused("committed with outputs: clear them")
    try:
        kernels.run(notebook, path.parent)
    except CellExecutionError as error:
        raise Refused(f"a cell raises: {error}") from error
    outputs = [output for cell in cells for output in cell.outputs]
    figures = [base64.b64decode(output.data["image/png"]) for output in outputs
               if "image/png" in output.get("data", {})]
    if not figures:
        raise Refused("draws no figure")
    for number, figure in enumerate(figures, 1):
        if colour(figure) < LEAST_COLOUR:
            raise Refused(f"figure {number} is blank")
    return figures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--figures", type=pathlib.Path)
    parser.add_argument("--refused", default="")
    parser.add_argument("notebooks", nargs="+", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:  # not the user's folders
        os.environ["IPYTHONDIR"] = os.environ["JUPYTER_RUNTIME_DIR"] = scratch
        kernels = Kernels()
        try:
            return check(options, kernels)
        finally:
            kernels.close()


def check(options, kernels):
    """Exit status."""
    failures = 0
    paths = [path for given in options.notebooks
             for path in (sorted(given.glob("*.ipynb")) if given.is_dir() else [given])]
    for path in paths:
        if "import halfstep" in path.read_text(encoding="utf-8") and not HAS_HALFSTEP:
            print(f"{path.name}: skipped, halfstep's Python module was not built")
            continue
        try:
            figures = figures_of(path.resolve(), kernels)
            said, fine = f"{len(figures)} figures", not options.refused
            for number, figure in enumerate(figures if options.figures else [], 1):
                options.figures.mkdir(parents=True, exist_ok=True)
                (options.figures / f"{path.stem}_{number}.png").write_bytes(figure)
        except Refused as reason:
            said, fine = str(reason), options.refused and options.refused in str(reason)
        except NoSuchKernel as error:
            print(f"Skipped: {error}")
            return 77
        failures += not fine
        print(f"{path.name}: {said}", flush=True)
    return 1 if failures or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
