extends Object
## Where things are in the interior, in metres: a warm room and a cool one in a row along x, and a
## yard behind the second doorway. The camera looks along −z into rooms whose front is cut away.

## Half the rooms' depth, and their height.
const DEPTH := 1.7
const HEIGHT := 2.5
const WALL := 0.2
const WARM := AABB(Vector3(-3.3, 0.0, -DEPTH), Vector3(3.2, HEIGHT, 2.0 * DEPTH))
const COOL := AABB(Vector3(0.1, 0.0, -DEPTH), Vector3(3.2, HEIGHT, 2.0 * DEPTH))
const YARD := AABB(Vector3(3.5, 0.0, -DEPTH), Vector3(3.7, 4.0, 2.0 * DEPTH))
## The x of the walls' sides, of both walls with a doorway.
const WALLS := Vector4(-0.1, 0.1, 3.3, 3.5)
## From z to z, and its height.
const DOORWAY := Vector3(-0.35, 0.85, 2.0)
const LAMP := Vector3(-1.75, 1.72, -0.55)
const LAMP_RADIUS := 0.17
const BALL_RADIUS := 0.4
## The ball rolls along x, in the middle of the doorways.
const BALL_Z := 0.25
const BALL_FROM := -2.3
const BALL_TO := 5.9
const TO_SUN := Vector3(0.855, 0.262, 0.447)


## Where the ball is after a part of its way there and back, as a turn in radians.
static func ball_at(turn: float) -> Vector3:
	# At the start it has just come through the first doorway.
	const START := 1.25
	var part := 0.5 - 0.5 * cos(turn + START)
	return Vector3(lerpf(BALL_FROM, BALL_TO, part), BALL_RADIUS, BALL_Z)
