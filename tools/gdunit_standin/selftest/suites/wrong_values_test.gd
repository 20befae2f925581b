extends GdUnitTestSuite
## Every test here has to fail.

const WRONG_CASES := [[1], [2]]


func test_equal() -> void:
	assert_int(1).is_equal(2)


func test_types_differ() -> void:
	assert_that(1).is_equal(1.0)


func test_nan_is_no_number() -> void:
	assert_float(NAN).is_equal_approx(0.0, 1.0)


func test_nan_between() -> void:
	assert_float(NAN).is_between(-1.0, 1.0)


func test_nan_in_a_vector() -> void:
	assert_vector(Vector3(0, NAN, 0)).is_equal_approx(Vector3.ZERO, Vector3.ONE)


func test_wrong_kind_of_assertion() -> void:
	assert_float(1).is_greater(0.0)


func test_null_is_not_less() -> void:
	assert_int(null).is_less(1)


func test_every_case(value: int, _test_parameters := WRONG_CASES) -> void:
	assert_int(value).is_zero()


func test_nested() -> void:
	assert_dict({"a": [1, 2]}).is_equal({"a": [1, 3]})


func test_order() -> void:
	assert_array([1, 2]).contains_exactly([2, 1])


func test_explicit() -> void:
	fail("on purpose")


func test_after_await() -> void:
	await await_idle_frame()
	assert_bool(true).is_false()


func test_other_error_than_expected() -> void:
	await assert_error(func() -> void: push_error("one")).is_push_error("another")


func test_expected_error_did_not_come() -> void:
	await assert_error(func() -> void: pass).is_push_error("another")


func test_signal_did_not_come() -> void:
	await assert_signal(self).wait_until(50).is_emitted("renamed")
