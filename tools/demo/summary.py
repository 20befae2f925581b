"""The closing table of `./dev demo`, and what its shell part reads from a recipe.

recipe FILE   prints the BRDF's name and "alpha_x,alpha_y".
table         prints a line for each picture with the error and the GPU time that ./dev compare measured, and writes
              the same as JSON: {"recipe", "size", "pictures": [{"environment", "renderer", "picture", "psnr", "flip",
              "relative_rmse", "gpu_ms"}]}.
"""

import argparse
import json
import sys
from pathlib import Path

MEASURES = ("psnr", "flip", "relative_rmse", "gpu_ms")


def read_json(path: Path):
    return json.loads(path.read_text(encoding="utf-8"))


def alpha_pair(recipe: dict) -> list[float]:
    alpha = recipe["alpha"]
    return list(alpha) if isinstance(alpha, list) else [alpha, alpha]


def print_recipe(arguments: argparse.Namespace) -> None:
    recipe = read_json(arguments.file)
    print(recipe["brdf"], ",".join(str(width) for width in alpha_pair(recipe)))


def merge(pictures: list[dict], measured: Path) -> list[dict]:
    """Each picture with the figures of its environment's eight lobes, if it was measured."""
    rows = []
    for picture in pictures:
        file = measured / f"{picture['environment'].lower()}.json"
        metrics = read_json(file) if file.exists() else []
        eight = next((entry for entry in metrics if entry["method"] == "gmm8"), {})
        rows.append({**picture, **{key: eight.get(key) for key in MEASURES}})
    return rows


def figure(value: float | None, form: str) -> str:
    return "–" if value is None else format(value, form)


def print_table(arguments: argparse.Namespace) -> None:
    recipe = read_json(arguments.recipe)
    rows = merge(read_json(arguments.pictures), arguments.measured)
    alpha = ", ".join(str(width) for width in alpha_pair(recipe))
    print()
    print(f"8 lobes, {recipe['brdf']} ({alpha}), on a sphere of {arguments.size}² pixels against the reference:")
    print(f"{'environment':<12}{'renderer':<18}{'PSNR dB':>8}{'FLIP':>8}{'rel. RMSE':>11}{'GPU ms':>8}  picture")
    for row in rows:
        figures = (
            f"{figure(row['psnr'], '.1f'):>8}{figure(row['flip'], '.3f'):>8}"
            f"{figure(row['relative_rmse'], '.3f'):>11}{figure(row['gpu_ms'], '.2f'):>8}"
        )
        print(f"{row['environment']:<12}{row['renderer']:<18}{figures}  {row['picture']}")
    if arguments.json:
        result = {"recipe": recipe, "size": arguments.size, "pictures": rows}
        temporary = arguments.json.with_name(arguments.json.name + ".tmp")
        temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
        temporary.replace(arguments.json)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    recipe = commands.add_parser("recipe")
    recipe.add_argument("file", type=Path)
    recipe.set_defaults(run=print_recipe)
    table = commands.add_parser("table")
    table.add_argument("--pictures", type=Path, required=True, help="what render_pictures.gd wrote")
    table.add_argument("--measured", type=Path, required=True, help="folder of ENVIRONMENT.json by ./dev compare")
    table.add_argument("--recipe", type=Path, required=True)
    table.add_argument("--size", type=int, required=True, help="pixels along the measured sphere's picture")
    table.add_argument("--json", type=Path)
    table.set_defaults(run=print_table)
    arguments = parser.parse_args()
    arguments.run(arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
