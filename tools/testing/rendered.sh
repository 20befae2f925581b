# shellcheck shell=bash
# Which rendered suites run in which renderer, and in which order.
#
# Nearly all of their time goes into compiling shaders for the software drivers, each material twice and more. So what
# Forward+ would compile and draw from the same text as Mobile is drawn in Mobile and in Compatibility.

# Suites that switch on what makes the engine compile more of every shader that comes later: subsurface scattering,
# lightmaps, voxels, multisampling. They come last.
LAST_SUITES=(vocabulary_shading_test engine_diffuse_test global_illumination_test)

# What is left to Compatibility: SUITE, or SUITE:TEST. Shaders of the rivals, drawn on squares, whose text has no branch for a
# renderer. Mobile draws each of them once (comparators_test), and ./dev test accuracy holds two against all renderers.
MOBILE_LEAVES_OUT=(
  comparators_test:test_fis_weights_and_levels
  comparators_test:test_fis_on_a_wider_pyramid_blurs_as_on_means_of_two_by_two
  comparators_test:test_fis_converges_to_the_reference comparators_test:test_white_furnace_of_fis
  comparators_test:test_white_furnace_of_toral comparators_test:test_toral_texture_holds_the_lobes
  comparators_test:test_toral_takes_the_lobes_of_the_nearest_view comparators_test:test_toral_levels
  comparators_test:test_dual_paraboloid_map_has_levels_of_two_by_two_means
  comparators_lobes_test
  comparators_prefiltered_test:test_white_furnace
  comparators_prefiltered_test:test_split_sum_is_exact_along_the_normal
  comparators_prefiltered_test:test_bent_normal_of_the_split_sum
  comparators_prefiltered_test:test_major_axis_lies_between_the_extrema_of_the_ellipse
  comparators_prefiltered_test:test_major_axis_follows_a_long_highlight

  # The demo's own scene: Mobile draws every environment by every method.
  demo_pictures_test:test_the_ball_shows_the_room_that_it_is_in
  demo_pictures_test:test_sliders_change_what_they_are_for
)

# What is left to Mobile and Compatibility. Everything else, and every new suite, runs in Forward+ too.
FORWARD_PLUS_LEAVES_OUT=(
  # Shaders of the rivals and of the references, drawn on squares: no light of the engine is in them, their text has no
  # branch for a renderer. comparison_test draws some of them in Forward+.
  comparators_test comparators_lobes_test comparators_prefiltered_test
  room_comparison_test turning_surface_test width_gradient_test

  # Formulas of the material in the light of the addon alone. In Forward+ its text is drawn by lobe_material_3d_test,
  # material_engine_test, material_surface_test and by what is left of these suites.
  furnace_test:test_isotropic_sphere furnace_test:test_anisotropic_sphere furnace_test:test_coloured_lobes
  furnace_test:test_small_and_large_radiance furnace_test:test_light_beyond_half_floats_stays_finite
  material_furnace_test:test_metal_plastic_and_coat material_furnace_test:test_extremes
  material_furnace_test:test_all_amounts_of_specular material_furnace_test:test_maps_of_metal_and_roughness
  material_surface_test:test_white_surfaces_send_all_light_back material_surface_test:test_a_coat_takes_what_it_reflects
  material_surface_test:test_dielectrics_reflect_as_specular_says
  material_surface_test:test_diffuse_light_is_the_cosines material_surface_test:test_diffuse_light_shows_no_star
  material_widths_test
  line_test:test_no_step_is_seen line_test:test_white_furnace
  sources_test
  occlusion_test:test_what_is_shut_is_black occlusion_test:test_reflections_behind_walls_and_in_grooves
  occlusion_test:test_the_surface_hides_what_is_below_its_horizon
  occlusion_test:test_plastic_reflects_and_scatters_what_it_sees
  occlusion_test:test_a_coat_is_occluded_about_the_mesh_normal
  occlusion_test:test_diffuse_light_comes_from_the_bent_normal
  occlusion_test:test_lights_of_places_are_hidden_as_the_worlds_is
  placed_light_test:test_outside_of_all_boxes_is_the_environment
  placed_light_test:test_lights_fade_by_the_depth_in_their_boxes
  placed_light_test:test_equal_priorities_are_mixed_and_higher_ones_come_first
  placed_light_test:test_reflections_lie_where_the_walls_are
  seam_test
  sheen_test:test_white_surfaces_send_all_light_back sheen_test:test_anisotropic_metal_keeps_its_light
  sheen_test:test_sheen_is_what_its_lobes_reflect sheen_test:test_a_texture_says_where_the_sheen_is
  vocabulary_coordinates_test
  vocabulary_shading_test:test_properties_do_what_godots_do

  # When something is captured, drawn, handed over or given back is decided by scripts that do not ask for the
  # renderer, with calls that Forward+ and Mobile answer by the same code of the engine. In Forward+ captures, skies and
  # updates are drawn by capture_test, sky_test, background_light_test, pyramid_test and by what is left of these suites.
  baked_probe_test
  damaged_light_test
  light_changes_test:test_a_new_node_takes_over_without_a_flash
  light_changes_test:test_what_has_left_for_good_gives_way_to_the_neutral_light
  light_changes_test:test_an_environment_that_fails_keeps_no_old_light
  light_changes_test:test_a_fade_goes_from_one_to_the_other light_changes_test:test_a_fade_into_the_next_goes_on
  live_textures_test
  probe_capture_test:test_a_closed_room_without_a_lamp_is_dark
  probe_capture_test:test_few_captures_come_to_what_endless_ones_show
  probe_places_test
  probe_schedule_test
  room_motion_test
  without_probes_test
  world_lights_test:test_a_second_light_flashes_in_neither_world
  world_lights_test:test_lights_are_turned_and_dimmed_in_their_worlds_only
  world_lights_test:test_cameras_that_come_later world_lights_test:test_a_scene_moves_to_another_world
  world_lights_test:test_a_world_with_no_light_of_its_own_shows_the_first
  world_lights_test:test_rooms_are_in_their_own_world world_lights_test:test_a_fifth_world_shows_the_first_one_s_light

  # The demo's own scene and controls. What Forward+ draws of it is compared with the engine's own material.
  demo_pictures_test:test_every_method_draws_every_environment
  demo_pictures_test:test_objects_are_where_they_should_be
  demo_pictures_test:test_the_divider_splits_the_picture_exactly
  demo_pictures_test:test_the_lamp_of_the_studio_moves_in_reflections
  demo_pictures_test:test_the_ball_shows_the_room_that_it_is_in
  demo_pictures_test:test_sliders_change_what_they_are_for
  demo_pictures_test:test_controls_are_drawn_in_both_layouts
)

# list_rendered RENDERER: sets $rendered to the arguments of gdUnit4's tool that name the suites.
list_rendered() {
  local name entry left_out=() whole=() suites=()
  rendered=()
  case $1 in
    mobile) left_out=("${MOBILE_LEAVES_OUT[@]}") ;;
    forward_plus) left_out=("${FORWARD_PLUS_LEAVES_OUT[@]}") ;;
  esac
  for entry in "${left_out[@]}"; do
    name=${entry%%:*}
    [[ -f $ROOT/tests/render/$name.gd ]] || die "test: $1 leaves out $entry, but there is no tests/render/$name.gd"
    if [[ $entry == *:* ]]; then
      rendered+=(-i "res://tests/render/$name.gd:${entry#*:}")
    else
      whole+=("$name")
    fi
  done
  for name in "$ROOT"/tests/render/*_test.gd; do
    name=$(basename "$name" .gd)
    is_one_of "$name" "${LAST_SUITES[@]}" "${whole[@]}" || suites+=("$name")
  done
  for name in "${suites[@]}" "${LAST_SUITES[@]}"; do
    rendered+=(-a "res://tests/render/$name.gd")
  done
}
