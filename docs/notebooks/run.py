"""Run the notebook, and store what its cells give: python docs/notebooks/run.py

Its cells are run in their order in one namespace, in the notebook's folder, as Jupyter does.
Jupyter is needed only to edit it. What a cell prints is stored, and the value of its last line.
"""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import json
from pathlib import Path
from typing import Any

NOTEBOOK = Path(__file__).parent / "perception.ipynb"
Cell = dict[str, Any]


def read_notebook() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(NOTEBOOK.read_text())
    return content


def code_cells(notebook: dict[str, Any]) -> list[Cell]:
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def run_cells(cells: list[Cell]) -> list[list[Cell]]:
    """The outputs of each cell, as nbformat 4 has them."""
    namespace: dict[str, Any] = {"__name__": "__main__"}
    with contextlib.chdir(NOTEBOOK.parent):
        return [_run(cell, number, namespace) for number, cell in enumerate(cells, 1)]


def text_of(outputs: list[Cell]) -> str:
    """What a cell prints, and its value where it is text."""
    parts = [part for each in outputs for part in each.get("text", [])]
    parts += [part for each in outputs for part in each.get("data", {}).get("text/plain", [])]
    return "".join(parts)


def _run(cell: Cell, number: int, namespace: dict[str, Any]) -> list[Cell]:
    tree = ast.parse("".join(cell["source"]), f"cell {number}")
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    value = None
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(tree, f"cell {number}", "exec"), namespace)
        if isinstance(last, ast.Expr):
            code = compile(ast.Expression(last.value), f"cell {number}", "eval")
            value = eval(code, namespace)
    outputs: list[Cell] = []
    if printed.getvalue():
        text = printed.getvalue().splitlines(keepends=True)
        outputs.append({"output_type": "stream", "name": "stdout", "text": text})
    if value is not None:
        result = {"output_type": "execute_result", "execution_count": number, "metadata": {}}
        outputs.append(result | {"data": _data_of(value)})
    return outputs


def _data_of(value: Any) -> Cell:
    """A picture by its own method, as Jupyter asks for it; anything else as text."""
    if hasattr(value, "_repr_jpeg_"):
        return {"image/jpeg": base64.b64encode(value._repr_jpeg_()).decode()}
    return {"text/plain": repr(value).splitlines(keepends=True)}


def main() -> None:
    notebook = read_notebook()
    cells = code_cells(notebook)
    for number, (cell, outputs) in enumerate(zip(cells, run_cells(cells), strict=True), 1):
        cell["execution_count"], cell["outputs"] = number, outputs
    NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
