#!/usr/bin/env bash
# The same scene in the three renderers: at least 99.9 % of the pixels differ by 1/255 at most.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/lib/common.sh"

need_engine
need_python
need_import
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for renderer in mobile gl_compatibility forward_plus; do
  godot_rendered "$renderer" --script res://tests/commands/renderers_scene.gd -- "$work/$renderer.png" \
    >"$work/log" 2>&1 || {
    cat "$work/log"
    die "renderers: $renderer drew no picture"
  }
done
"$PYTHON" - "$work" <<'PYTHON_END'
import sys
from itertools import combinations

import numpy as np
from PIL import Image

LEAST_SHARE = 0.999
names = ["mobile", "gl_compatibility", "forward_plus"]
pictures = {name: np.asarray(Image.open(f"{sys.argv[1]}/{name}.png"), dtype=int) for name in names}
passed = failed = 0
for one, other in combinations(names, 2):
    apart = np.abs(pictures[one] - pictures[other]).max(axis=-1)
    share = float(np.mean(apart <= 1))
    fine = share >= LEAST_SHARE
    passed += fine
    failed += not fine
    verdict = "passed" if fine else "FAILED"
    print(f"  {one}, {other}: {verdict}, {100 * share:.3f} % within 1/255, at most {apart.max()}/255")
# A picture of nothing would agree with itself.
for name in names:
    fine = float(pictures[name].std()) > 20.0
    passed += fine
    failed += not fine
    print(f"  {name} shows something: {'passed' if fine else 'FAILED'}")
print(f"renderers: {passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
PYTHON_END
