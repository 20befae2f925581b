#!/usr/bin/env bash
# measures error against run time of every method and writes docs/report ([--quick] [--minutes N] [--renderers R,R] [--maps F,F] [--device])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev report [--quick] [--minutes N] [--device] [--renderers R,R…] [--maps FILE,FILE…] [OPTIONS]
       ./dev report --rooms [--renderer R] [--size N] [--samples N] [--timing-rounds N] [--cases N] [--json FILE] [--out DIR]

--quick          a few cases at 64 x 64 in the Mobile renderer, in a few minutes
--minutes N      measures no longer than that, and writes the report of what there is; what says the most is measured
                 first: the timed materials in every renderer. The same command goes on
--device         times on the GPU of your display, added to what DIR has; 512 x 512, times at 1024 x 1024
--renderers R,R  of mobile, gl_compatibility, forward_plus (default: all); the first one measures most
--methods M,M…   no others (default: all)
--maps F,F…      these maps too (.exr or .hdr); GPU times are of hall.exr
--cases N        the first N cases only
--size N         pixels along the side of the pictures (default 128); times are taken at 256 x 256
--samples N      of the reference, a pixel (default 640)
--timing-rounds N   GPU times of every method, in turns (default 7)
--json FILE      the verdicts and every figure there too
--out DIR        README.md, index.html, compare/results.json, compare/results.csv and the figures (default: docs/report;
                 below build/report with --quick, --maps, --renderers, --methods, --cases, --size, --samples or
                 --timing-rounds)

--rooms          instead of all that, a sphere in three rooms, in three places and of three materials, in one renderer
                 (default: mobile, 128 x 128, 256 samples, docs/report/rooms): some minutes

A run that was stopped goes on: cases that DIR/compare/results.json has, measured with the same sources and maps, are
kept. Takes most of an hour on two cores. The metric is that of ./dev compare, and the pictures are drawn by its code.
Methods, materials, maps and settings are those of tools/report/cases.py.
USAGE
}

help_if_asked "$@"

script=report.py
if [[ " $* " == *" --rooms "* ]]; then script=rooms.py; fi
need_python report
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
# What is wrong with the options is said before anything is built.
"$PYTHON" "$ROOT/tools/report/$script" --check "$@"
if [[ " $* " == *" --device "* && -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
  die "report: --device draws with the GPU of your display, but neither DISPLAY nor WAYLAND_DISPLAY is set"
fi
need_engine
need_library
need_import
exec "$PYTHON" "$ROOT/tools/report/$script" "$@"
