# shellcheck shell=bash
# Which rendered suites run in which renderer, and in which order.
#
# Compatibility draws every suite, but for a few long ones. Mobile and Forward+ draw what is named here, for there nearly all of
# a suite's time goes into compiling shaders for the software driver, each material several times. Named is what they do in a
# way of their own: a branch of a shader, a path of a script, or what of the engine a suite is about. All else is a formula
# whose text is the same in every renderer; that it comes to the same pixels is what ./dev test renderers checks, with every
# include of materials. ./dev test --thorough draws every suite in every renderer.

# Suites that switch on what makes the engine compile more of every shader that comes later: reflection probes, lightmaps,
# subsurface scattering, antialiasing over frames, voxels. They come last, those that add most at the end.
LAST_SUITES=(comparators_prefiltered_test room_comparison_test demo_pictures_test material_engine_test vocabulary_shading_test
  engine_diffuse_test line_shift_test global_illumination_test)

# SUITE, or SUITE:TEST.
COMPATIBILITY_LEAVES_OUT=(
  # The rivals of ./dev compare, which no game has, one by one; test_all_methods_draw_the_same_pixels draws them all once.
  comparators_lobes_test comparators_prefiltered_test:test_white_furnace
  comparators_prefiltered_test:test_stock_shows_the_panorama_where_the_others_do
  comparators_prefiltered_test:test_split_sum_is_exact_along_the_normal
  comparators_prefiltered_test:test_bent_normal_of_the_split_sum
  comparators_prefiltered_test:test_major_axis_lies_between_the_extrema_of_the_ellipse
  comparators_prefiltered_test:test_major_axis_follows_a_long_highlight
  comparators_test:test_fis_weights_and_levels comparators_test:test_fis_converges_to_the_reference
  comparators_test:test_white_furnace_of_fis room_comparison_test

  # Whole rooms and scenes, by every method and at every step.
  demo_pictures_test:test_every_method_draws_every_environment
  demo_pictures_test:test_the_ball_shows_the_room_that_it_is_in
  room_motion_test:test_no_step_shows_more_than_the_reference
  line_test:test_no_step_is_seen width_gradient_test turning_surface_test
  material_furnace_test:test_extremes material_furnace_test:test_in_a_room
  probe_schedule_test:test_hundreds_of_updates_leave_nothing_behind
)

MOBILE_DRAWS=(
  # Light is drawn and read back by the rendering device, where Compatibility packs it into viewports.
  pyramid_test:test_constant_stays_constant pyramid_test:test_light_of_the_sphere_is_kept pyramid_test:test_no_seam
  pyramid_test:test_level_0_is_blurred_where_the_panorama_is_coarse pyramid_test:test_bad_texels_are_dark
  pyramid_test:test_srgb_pictures_are_decoded pyramid_test:test_fine_panoramas_lose_no_light
  cpu_pyramid_test gpu_cube_test held_panorama_test linear_viewport_test
  live_sources_test:test_no_light_is_lost live_sources_test:test_they_are_those_that_the_library_finds
  live_sources_test:test_an_answer_that_cannot_be_read_is_none
  live_sources_test:test_the_memory_for_the_search_is_given_back live_sources_test:test_the_sun_of_a_sky_is_lit_once
  live_sources_test:test_a_sun_at_the_corner_of_views_is_one live_sources_test:test_slices
  moving_widths_test
  # What Compatibility does in a way of its own, or leaves out.
  material_surface_test:test_transparency material_engine_test:test_decals_change_the_engines_lights_only
  probe_places_test:test_worlds_take_from_the_places background_light_test:test_a_sky_that_is_missing
  baked_light_test:test_the_first_drawn_frame_is_that_of_the_live_light
  baked_light_test:test_two_worlds_show_their_own_in_the_first_frame
  environment_bake_test:test_captures
  light_changes_test:test_a_sky_takes_over_without_a_flash light_changes_test:test_the_scene_of_the_tree_changes_without_a_flash
  light_changes_test:test_a_fade_into_the_next_goes_on
  lobe_environment_3d_test update_modes_test update_pace_test first_frame_test exit_test

  # The engine's skies, backgrounds and captures, each renderer's own.
  sky_test orientation_test
  background_light_test:test_a_sky_behind_a_colour background_light_test:test_no_environment_at_all
  capture_test:test_mirror_shows_the_scene capture_test:test_tone_mapping_and_effects_do_not_count
  capture_test:test_mirrors_in_the_scene_show_the_update_before capture_test:test_a_closed_room_without_a_lamp_is_dark

  # Places: the rendering device has one array of cube maps for them, Compatibility four samplers.
  placed_light_test:test_materials_with_holes_are_drawn placed_light_test:test_places_are_those_of_moved_vertices
  placed_light_test:test_equal_priorities_are_mixed_and_higher_ones_come_first
  placed_light_test:test_reflections_lie_where_the_walls_are
  probe_places_test:test_the_nearest_show
  probe_schedule_test:test_freed_at_any_moment
  world_lights_test:test_worlds_show_their_own_lights world_lights_test:test_a_sky_s_energy_shows_at_once
  world_lights_test:test_cameras_change_their_masks world_lights_test:test_captures_see_their_own_world

  # What the engine does to materials: its lights, decals, fog, alpha, refraction, its limit of roughness.
  decals_test
  antialiasing_test:test_variance_widens_reflections
  lobe_material_3d_test:test_lobes_are_where_the_table_says lobe_material_3d_test:test_poor_meshes_stay_finite
  lobe_material_3d_test:test_properties_change_while_running lobe_material_3d_test:test_mirrored_mesh
  lobe_material_3d_test:test_materials_may_be_made_on_threads
  lobe_material_3d_test:test_neutral_light_without_environment
  material_engine_test:test_highlights_lie_as_godots material_engine_test:test_fog
  material_engine_test:test_ambient_light_is_not_added material_engine_test:test_lightmaps_take_no_reflections_for_lamps
  material_engine_test:test_two_viewports_with_cameras_of_their_own material_engine_test:test_kinds_of_meshes
  material_engine_test:test_uneven_scale
  vocabulary_shading_test:test_refraction_behind_a_colour vocabulary_shading_test:test_fog
  vocabulary_shading_test:test_shadows vocabulary_shading_test:test_edges_of_alpha
  vocabulary_shading_test:test_emission_in_nits
  engine_diffuse_test:test_energy_that_lobes_lose_counts_in_lamps
  demo_pictures_test:test_the_lamp_of_the_studio_moves_in_reflections

  # One of each way to a material of one's own.
  own_shaders_test:test_a_lobe_shader_material_binds_itself_and_saves_nothing_of_the_light
  own_shaders_test:test_includes_may_be_relative
  own_shader_examples_test:test_first_shader_of_the_page
  visual_shader_test:test_nodes_share_a_graph visual_shader_test:test_the_sky_is_followed
  frozen_materials_test:test_a_frozen_material_shows_sources_where_there_are_any
  examples_test:test_cloth
)

# Scripts and drawing are those of Mobile; the engine's lights, its passes before and after and its antialiasing are not.
FORWARD_PLUS_DRAWS=(
  line_shift_test:test_only_where_frames_are_kept line_shift_test:test_the_mean_of_frames_is_nearer_to_more_lobes
  global_illumination_test decals_test exit_test gpu_cube_test linear_viewport_test
  engine_diffuse_test:test_switches_are_noticed
  engine_diffuse_test:test_screen_occlusion_acts_on_the_environments_light
  material_engine_test:test_highlights_lie_as_godots material_engine_test:test_fog
  material_engine_test:test_two_viewports_with_cameras_of_their_own
  vocabulary_shading_test:test_refraction_behind_a_colour vocabulary_shading_test:test_edges_of_alpha
  antialiasing_test:test_variance_widens_reflections
  first_frame_test:test_the_first_frame_has_the_light
  lobe_material_3d_test:test_poor_meshes_stay_finite lobe_material_3d_test:test_materials_may_be_made_on_threads
  live_sources_test:test_slices
  placed_light_test:test_places_are_those_of_moved_vertices
  sky_test:test_the_world_s_environment sky_test:test_fog_before_the_sky
  update_modes_test:test_a_change_shows_in_the_next_frame update_modes_test:test_other_sizes_leave_nothing_behind
  update_modes_test:test_hundreds_of_updates_leave_nothing_behind
  world_lights_test:test_cameras_change_their_masks
  own_shaders_test:test_a_lobe_shader_material_binds_itself_and_saves_nothing_of_the_light
  visual_shader_test:test_the_sky_is_followed
  moving_widths_test
)

# list_rendered RENDERER: sets $rendered to the arguments of gdUnit4's tool that name the suites.
list_rendered() {
  local renderer=$1 name file test suites=() entries=()
  rendered=()
  case ${LOBELIGHT_THOROUGH:-}$renderer in
    mobile) entries=("${MOBILE_DRAWS[@]}") ;;
    forward_plus) entries=("${FORWARD_PLUS_DRAWS[@]}") ;;
    *)
      for file in "$ROOT"/tests/render/*_test.gd; do
        name=$(basename "$file" .gd)
        is_one_of "${LOBELIGHT_THOROUGH:-}$name" "${COMPATIBILITY_LEAVES_OUT[@]}" || entries+=("$name")
      done
      ;;
  esac
  check_drawn "${entries[@]}" "${LAST_SUITES[@]}" "${COMPATIBILITY_LEAVES_OUT[@]}"
  mapfile -t suites < <(printf '%s\n' "${entries[@]%%:*}" | LC_ALL=C sort -u)
  for name in $(in_order "${suites[@]}"); do
    rendered+=(-a "res://tests/render/$name.gd")
    while read -r test; do
      is_drawn "$renderer" "$name" "$test" "${entries[@]}" || rendered+=(-i "res://tests/render/$name.gd:$test")
    done < <(tests_of "$name")
  done
}

# is_drawn RENDERER SUITE TEST ENTRY…: whether the entries are for this test of this suite.
is_drawn() {
  local renderer=$1 name=$2 test=$3
  shift 3
  if [[ $renderer == gl_compatibility && -z ${LOBELIGHT_THOROUGH:-} ]]; then
    ! is_one_of "$name:$test" "${COMPATIBILITY_LEAVES_OUT[@]}"
  else
    is_one_of "$name" "$@" || is_one_of "$name:$test" "$@"
  fi
}

# tests_of SUITE: prints the names of its tests, one a line.
tests_of() {
  sed -n 's/^func \(test_[A-Za-z0-9_]*\)(.*/\1/p' "$ROOT/tests/render/$1.gd"
}

# in_order SUITE…: prints them, LAST_SUITES last.
in_order() {
  local name
  for name in "$@"; do
    is_one_of "$name" "${LAST_SUITES[@]}" || echo "$name"
  done
  for name in "${LAST_SUITES[@]}"; do
    is_one_of "$name" "$@" && echo "$name"
  done
  return 0
}

# check_drawn ENTRY…: ends with a sentence where there is no such suite or test.
check_drawn() {
  local entry file
  for entry in "$@"; do
    file=tests/render/${entry%%:*}.gd
    [[ -f $ROOT/$file ]] || die "test: tools/testing/rendered.sh names $entry, but there is no $file"
    [[ $entry != *:* ]] || grep -q "^func ${entry#*:}(" "$ROOT/$file" \
      || die "test: tools/testing/rendered.sh names $entry, but $file has no such test"
  done
}
