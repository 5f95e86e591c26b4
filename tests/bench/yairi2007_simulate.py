"""The robot's walk and what it observes, in numpy: the rules of docs/methods/simulator.md."""
import numpy

TURNS = numpy.arange(0.0, numpy.pi, numpy.pi / 90.0)
SIDES = numpy.stack([TURNS, -TURNS], axis=1).ravel()  # 0, -0, 2, -2 degrees, ...


def walk(world, options, steps, random):
    """x, y and heading of each observation, steps x 3."""
    landmarks = numpy.array(world["landmarks_m"])
    low, high = options["wall_margin_m"], world["side_m"] - options["wall_margin_m"]
    least = (options["clearance_m"] + world["landmark_diameter_m"] / 2.0) ** 2
    substeps = round(options["step_m"] / options["substep_m"])
    length = options["step_m"] / substeps

    def free(x, y):
        """Of many places at once."""
        clear = ((landmarks[:, 0] - x[:, None]) ** 2 + (landmarks[:, 1] - y[:, None]) ** 2 >=
                 least).all(axis=1)
        return clear & (x >= low) & (y >= low) & (x <= high) & (y <= high)

    def first_place():
        while True:
            x, y = random.uniform(0.0, world["side_m"], (2, 1))
            if free(x, y)[0]:
                return x[0], y[0]

    x, y = first_place()
    heading = random.uniform(-numpy.pi, numpy.pi)
    path = numpy.empty((steps, 3))
    for step in range(steps):
        path[step] = x, y, heading
        heading += random.uniform(-options["heading_change_rad"], options["heading_change_rad"])
        left = substeps
        while left > 0:
            # As far as the way is free, then the smallest turn that frees it.
            ahead = length * numpy.arange(1, left + 1)
            clear = free(x + ahead * numpy.cos(heading), y + ahead * numpy.sin(heading))
            count = left if clear.all() else int(clear.argmin())
            x += count * length * numpy.cos(heading)
            y += count * length * numpy.sin(heading)
            left -= count
            if left == 0:
                break
            angles = heading + SIDES
            clear = free(x + length * numpy.cos(angles), y + length * numpy.sin(angles))
            if not clear.any():
                heading += numpy.pi
                break
            heading = angles[clear.argmax()]
    return path


def bearings(landmarks, path):
    offsets = landmarks[:, None, :] - path[None, :, :2]
    angles = numpy.arctan2(offsets[..., 1], offsets[..., 0]) - path[:, 2]
    return (angles + numpy.pi) % (2.0 * numpy.pi) - numpy.pi


def visibility(landmarks, path, diameter, options):
    """1 where a landmark scans wide enough and no nearer one stands before its centre."""
    radius = diameter / 2.0
    reach = radius / numpy.sin(options["visual_angle_rad"] / 2.0)
    seen = numpy.zeros((len(landmarks), len(path)))
    for step, position in enumerate(path[:, :2]):
        offsets = landmarks - position
        squares = (offsets ** 2).sum(axis=1)
        near = numpy.flatnonzero(squares <= reach * reach)
        to, square = offsets[near], squares[near]
        share = numpy.clip(to @ to.T / square, 0.0, 1.0)  # of j along the ray to i, in [j, i]
        gap = ((share[..., None] * to[None] - to[:, None]) ** 2).sum(axis=2)
        hides = (gap < radius * radius) & (square[:, None] < square[None, :])
        seen[near[~hides.any(axis=0)] if options["occlusion"] else near, step] = 1.0
    return seen


def observe(world, path, sensor, options):
    landmarks = numpy.array(world["landmarks_m"])
    if sensor == "bearing":
        return bearings(landmarks, path)
    return visibility(landmarks, path, world["landmark_diameter_m"], options)
