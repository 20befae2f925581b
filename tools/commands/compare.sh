#!/usr/bin/env bash
# draws one sphere by several methods beside a reference (--env FILE | --room ROOM.json --brdf B --alpha AX,AY --methods M,M --out DIR)
source "$(dirname "${BASH_SOURCE[0]}")/../lib/common.sh"

usage() {
  cat <<USAGE
usage: ./dev compare --env FILE --brdf B --alpha AX,AY --methods M,M,… --out DIR [OPTIONS]
       ./dev compare --room ROOM.json --brdf B --alpha AX,AY --methods M,M,… --out DIR [OPTIONS]

--methods       gmm<lobes> (gmm1, gmm2, gmm4, gmm8 …); gmm<lobes>r: with refined lobes
                line4 line8 … line40: so many lobes along the highlight, computed without a table
                auto: what a material of these widths draws by itself, of ready tables and without
                fis8 fis16 fis40: filtered importance sampling on 2x2 means, in the best form (--fis); fis40g: on the
                pyramid of gmm
                toral8 toral16: the thesis as written
                allfreq1 allfreq8: spherical Gaussians for the normals' density, warped (Wang et al. 2009)
                asg: one anisotropic spherical Gaussian (Xu et al. 2013), drawn as eight round ones
                closed8: eight lobes in closed form, without a table
                majoraxis8 majoraxis32: samples along the major axis of a prefiltered map (Cocco, Zanni and Chermain 2024)
                splitsum: a map filtered for this very width times the albedo; with a bent normal if anisotropic
                stock: StandardMaterial3D under the engine's own sky; always GGX, to 10:1; see bake/comparators/stock.gd
                reference: with itself
--size N        pixels along the side (default 256)
--renderer R    mobile (default), gl_compatibility or forward_plus
--filter F      of the pyramid of gmm, line, auto, fis40g, allfreq, asg and closed8: disc (default), gaussian, binomial or box
--light L       of gmm, line and auto: live (default), drawn on the GPU while the program runs, or baked, as it is imported and saved
--max-sources N suns and lamps that are taken out of that light (default 4); 0 leaves all in the map
--samples N     of the reference, a pixel
--timing-rounds N   GPU times of every method, in turns (default 15); 0 measures none
--timing-size N pixels along the side where times are measured (default 256)
--coverage C    of toral: the share of a lobe that its texels cover (default 0.47)
--views T,P     of toral: fitted views, elevations and azimuths (default 64,1 or 64,32)
--bias B        of fis: added to the published level (default 0)
--fis F         best (default): kernels by the density's integral for Ward (Tokuyoshi 2016), bounded visible normals for GGX
                (Tokuyoshi and Eto 2024); published: Colbert and Krivanek 2007; integral: those kernels for GGX too
--json FILE     writes metrics.json there too

--room          the sphere stands in a box whose walls emit the radiance of pictures. ROOM.json, in metres, the box's middle
                being the origin and paths relative to the file:
                  {"size": [X, Y, Z],
                   "walls": {"+x": FILE, "-x": FILE, "+y": FILE, "-y": FILE, "+z": FILE, "-z": FILE},
                   "probe": [x, y, z], "sphere": {"centre": [x, y, z], "radius": r}}
                A wall's point q has d = q / (size / 2), and (s, t) = +x: (-z, -y), -x: (z, -y), +y: (x, z), -y: (x, -z),
                +z: (x, -y), -z: (-x, -y) of d; u = (s + 1) / 2, v = (t + 1) / 2, row 0 at v = 0; bilinear, clamped.
                The sphere is drawn as without a room, its points being centre + radius n; it hides nothing. Light is
                captured at the probe. Methods:
                gmm<lobes>: a LobeProbe3D of the box's size; gmm<lobes>_flat: the same light, from infinitely far away
                fis8 fis16 fis40 fis40g: samples projected to the box
                stock: an interior ReflectionProbe with box projection, drawn once, at its best settings
                reference: with itself
                --filter counts for fis40g only. tools/compare/rooms.py cuts panoramas into rooms.

Writes reference.exr, <method>.exr (linear radiance), <method>_difference.png, sheet.png, metrics.json and plan.json,
which says how each method was set up and has the times of the rounds.
gpu_ms is a median; gpu_ms_ratio the median of each round's time over that of gmm8, or of the first method without it.
fixed_ms is what the renderer takes for a frame whose sphere reflects nothing, gpu_ms_ratio_without_fixed the ratio of
what both times have above it.
PSNR: over the sphere's pixels with x² + y² < 0.9995; exposure takes the reference's median of (R+G+B)/3
to 0.18; clamped to [0, 1]; power 1/2.2; −10 log10 of the mean squared error of the three channels.
USAGE
}

renderer=mobile
json=""
out=""
arguments=()
while (($# > 0)); do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --renderer | --json | --out)
      (($# > 1)) || die "compare: $1 needs a value"
      case $1 in
        --renderer) renderer=$2 ;;
        --json) json=$(realpath -m -- "$2") ;;
        --out)
          out=$2
          arguments+=(--out "$2")
          ;;
      esac
      shift 2
      ;;
    *)
      arguments+=("$1")
      shift
      ;;
  esac
done
check_renderer compare "$renderer"

need_engine
need_library
need_import
need_python
export LOBELIGHT_CWD=$PWD LOBELIGHT_TERMINAL=0
if [[ -t 1 ]]; then LOBELIGHT_TERMINAL=1; fi
godot_rendered "$renderer" --no-header --script res://bake/compare.gd -- "${arguments[@]}"
"$PYTHON" "$ROOT/tools/compare/metrics.py" "$out" ${json:+--json "$json"}
