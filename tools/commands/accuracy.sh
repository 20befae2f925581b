#!/usr/bin/env bash
# measures the error of lobes over materials and maps beside FIS ([--quick] [--maps FILE,…] [--only PART] [--out DIR])
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev accuracy [--quick] [--maps FILE,FILE…] [OPTIONS]

--quick          a few cases at 64 x 64, in two minutes
--maps F,F…      these maps too (.exr or .hdr), in the part maps
--only PART      measures one part; what DIR has of the others stays in the report
                 maps: eight lobes on every map, widths 0.01 to 0.2
                 leads: ratios of 1:20, 1:50 and 1:100 and the widest lobes, on every map, against fis40
                 ratios: error against fetches, ratios of the widths from 1 to 100
                 grid: widths from 0.01 to 0.5, at most 16 fetches against fis40
--minutes N      measures no longer than that, the part leads first, and writes the report of what there is
--renderer R     mobile (default), gl_compatibility or forward_plus
--size N         pixels along the side (default 96)
--samples N      of the reference, a pixel (default 640)
--timing-rounds N   GPU times of every method, in turns (default 5)
--json FILE      the figures there too
--out DIR        README.md, results.json, results.csv and the figures (default: docs/report/accuracy;
                 below build/accuracy with --quick, --maps, --only, --size or another renderer)

A run that was stopped goes on: cases that DIR/results.json has, measured with the same sources and maps, are kept.
Takes about half an hour on two cores. The metric is that of ./dev compare.
USAGE
}

help_if_asked "$@"

need_python accuracy
export PYTHONDONTWRITEBYTECODE=1 LOBELIGHT_CWD=$PWD
# What is wrong with the options is said before anything is built.
"$PYTHON" "$ROOT/tools/accuracy/accuracy.py" --check "$@"
need_engine
need_library
need_import
exec "$PYTHON" "$ROOT/tools/accuracy/accuracy.py" "$@"
