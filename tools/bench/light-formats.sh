#!/usr/bin/env bash
# What the formats of saved light cost in quality and in bytes: see usage().
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/rendered.sh"

usage() {
  cat <<USAGE
usage: ./dev bench light-formats --env FILE [--renderer R] [--formats F:N,…] [--alphas A,…] [--lobes N] [--size N] [--json FILE]

A panorama, filtered by the library, lights GGX spheres of several widths by its faces in several formats. PSNR is that of
./dev compare, beside the reference integrator and beside the first format, which is what live light has.

--env FILE     the panorama (.exr or .hdr)
--renderer R   mobile (default), gl_compatibility or forward_plus
--formats      half, rgb9e5, bptc (BC6H) or astc, each with the texels along the side of a face
               (default half:512,rgb9e5:512,rgb9e5:256,bptc:512,astc:512)
--alphas       widths (default 0.01,0.02,0.05,0.1,0.2,0.5)
--lobes N      lobes of the materials (default 8)
--size N       pixels along the side of a picture (default 128)
--json FILE    [{"env", "alpha", "lobes", "format", "bytes", "psnr", "psnr_to_first"}]
USAGE
}

help_if_asked "$@"
bench_rendered light-formats res://bake/bench_light_formats.gd "$@"
