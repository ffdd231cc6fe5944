"""Machined, cast and bent parts, no two alike. Each function makes one solid, in millimetres."""
import math

from solids import (around, ball, block, box, cone, cut, cylinder, extruded, fuse, moved, occ,
                    plane, polyline, prism, revolved, ring, rounded, rounded_block, slot, turned,
                    vertical)

PI = math.pi


def polar(radius, angle_rad):
    return radius * math.cos(angle_rad), radius * math.sin(angle_rad)


def holes(radius, places, depth=200, z=-100):
    return [cylinder(radius, depth, x, y, z) for x, y in places]


def angle_bracket():
    body = fuse(block(62, 44, 5), box(-31, -22, 0, 5, 44, 48))
    for y in (-18, 13):
        rib = prism([(-27, 5), (8, 5), (-27, 36)], 5)
        body = fuse(body, moved(turned(rib, PI / 2, (1, 0, 0)), y=y + 5))
    wall_hole = turned(slot(10, 9, 40, z=-20), PI / 2, (0, 1, 0))
    return cut(body, *holes(3.5, [(20, -13), (20, 13)]), moved(wall_hole, x=-30, z=33))


def pipe_flange():
    body = revolved([(18, 0), (52, 0), (52, 11), (30, 14), (25, 38), (18, 38)])
    return cut(body, *holes(4.5, [polar(41, 2 * PI * k / 6) for k in range(6)]))


def manifold():
    body = fuse(block(90, 38, 34), cylinder(14, 9, x=-25, z=34), cylinder(10, 6, x=22, z=34),
                cylinder(9, 8, x=22, y=-27, z=17, axis=(0, 1, 0)))
    ports = [cylinder(9, 40, x=-25, z=14), cylinder(5, 40, x=22, z=14),
             cylinder(6, 110, x=-55, z=16, axis=(1, 0, 0)),
             cylinder(4.5, 30, x=22, y=-30, z=17, axis=(0, 1, 0))]
    return cut(body, *ports, *holes(3, [(-40, 14), (40, 14), (40, -14)]), block(20, 6, 8, y=18))


def cover():
    body = rounded_block(84, 58, 4, 10)
    body = fuse(body, cut(rounded_block(70, 44, 13, 6), rounded_block(64, 38, 9, 4)))
    body = cut(body, *holes(2.2, [(sx * 37, sy * 24) for sx in (-1, 1) for sy in (-1, 1)]))
    window = slot(20, 8, 30, x=-12, y=6)
    return cut(body, window, cylinder(6, 30, x=20, y=-6))


def star_knob():
    lobes = around(lambda: cylinder(9, 16, x=19), 5)
    body = fuse(cylinder(20, 16), *lobes, cone(15, 11, 20, z=-20))
    scoops = around(lambda: cylinder(8, 40, x=26, z=-5), 5, PI / 5)
    return cut(body, *scoops, cylinder(4, 30, z=-25), cylinder(9, 3, z=13))


def hand_lever():
    arm = prism([(0, -9), (95, -5), (95, 5), (0, 9)], 8, z=4)
    body = fuse(cylinder(16, 22), arm, cylinder(9, 14, x=95, z=1), ball(11, x=95, z=22))
    return cut(body, cylinder(8, 40, z=-5), block(5, 20, 40, x=8, z=-5), cylinder(2.5, 30, x=45))


def saddle_clamp():
    body = fuse(block(86, 26, 7), cylinder(26, 26, y=-13, z=7, axis=(0, 1, 0)))
    body = cut(body, cylinder(20, 40, y=-20, z=7, axis=(0, 1, 0)), block(200, 40, 60, z=-60))
    slots = [slot(5, 7, 30, x=35), cylinder(3.5, 30, x=-35)]
    return cut(body, *slots, block(10, 8, 40, y=9, z=28))


def v_pulley():
    body = revolved([(8, -14), (16, -14), (16, -5), (34, -5), (34, -10), (46, -10), (38, -2),
                     (38, 2), (46, 10), (34, 10), (34, 5), (16, 5), (16, 9), (8, 9)])
    windows = around(lambda: cylinder(6.5, 40, x=25, z=-20), 4)
    return cut(body, *windows, block(5, 6, 40, x=9, z=-20))


def impeller():
    def blade():
        radii = [11 + 33 * k / 12 for k in range(13)]
        angles = [1.0 * (k / 12) ** 0.8 for k in range(13)]
        side = [polar(r, a + 1.3 / r) for r, a in zip(radii, angles)]
        other = [polar(r, a - 1.3 / r) for r, a in zip(radii, angles)]
        return prism([*side, *other[::-1]], 15, z=3)

    hub = revolved([(3, 0), (14, 0), (14, 8), (9, 22), (3, 24)])
    body = fuse(cylinder(46, 4), hub, *around(blade, 7))
    return cut(body, cylinder(5, 60, z=-20))


def spring_clip():
    sheet = [box(0, -10, 0, 50, 20, 1.2), box(0, -10, 0, 1.2, 20, 22),
             box(0, -10, 20.8, 30, 20, 1.2)]
    tongue = moved(turned(box(0, -6, 0, 24, 12, 1.2), 0.5, (0, 1, 0)), x=29, z=21)
    hook = ring(5, 3.8, 20, x=50, y=-10, z=5, axis=(0, 1, 0))
    body = fuse(*sheet, tongue, hook)
    return cut(body, cylinder(4, 10, x=25, z=-5), block(14, 5, 60, x=8, z=10))


def elbow():
    pipe, bore = ((3, occ.addTorus(0, 0, 0, 45, radius, angle=PI / 2)) for radius in (15, 11))
    straight = cylinder(15, 22, x=45, y=-22, axis=(0, 1, 0))
    square = box(-12, 45 - 22, -22, 7, 44, 44)
    round_flange = cylinder(24, 6, x=45, y=-22, axis=(0, 1, 0))
    end = cylinder(15, 12, x=-12, y=45, axis=(1, 0, 0))
    body = fuse(pipe, straight, square, round_flange, end)
    body = cut(body, bore, cylinder(11, 40, x=45, y=-40, axis=(0, 1, 0)),
               cylinder(11, 40, x=-40, y=45, axis=(1, 0, 0)))
    bolts = [cylinder(2.5, 30, x=-20, y=45 + sy * 16, z=sz * 16, axis=(1, 0, 0))
             for sy in (-1, 1) for sz in (-1, 1)]
    return cut(body, *bolts)


def rod_end():
    eye = cut(cylinder(17, 14, z=-7), ball(11))
    body = fuse(eye, cylinder(8, 48, x=14, axis=(1, 0, 0)),
                turned_hexagon(11, 10, x=28))
    return cut(body, cylinder(4, 40, x=45, axis=(1, 0, 0)))


def turned_hexagon(radius, height, x):
    """A hexagonal prism along x."""
    points = [polar(radius, 2 * PI * k / 6) for k in range(6)]
    return moved(turned(prism(points, height), PI / 2, (0, 1, 0)), x=x)


def clevis():
    body = fuse(block(30, 30, 34, z=0), cylinder(15, 30, x=0, y=-15, z=34, axis=(0, 1, 0)),
                cylinder(10, 26, z=-26))
    body = cut(body, block(40, 13, 60, z=10), cylinder(6, 60, y=-30, z=34, axis=(0, 1, 0)))
    return cut(body, cylinder(2.5, 40, x=-20, z=-18, axis=(1, 0, 0)))


def heat_sink():
    fins = [box(-35 + 7.2 * k, -22, 0, 2, 44, 16 + 2.2 * k) for k in range(10)]
    body = fuse(block(72, 44, 5, z=-4), *fins)
    return cut(body, block(24, 12, 60, x=-24, y=20, z=0), *holes(2.5, [(-24, 18), (28, -16)]))


def gear_outline(teeth, root, tip):
    points = []
    for k in range(teeth):
        for offset, radius in ((-0.26, root), (-0.12, tip), (0.12, tip), (0.26, root)):
            points.append(polar(radius, 2 * PI * (k + offset) / teeth))
    return points


def spur_gear():
    body = prism(gear_outline(22, 31, 36), 12)
    body = fuse(cut(body, ring(26, 13, 4, z=8), ring(26, 13, 4)), cylinder(11, 22))
    return cut(body, cylinder(6, 40, z=-5), block(4, 4, 40, x=6, z=-5),
               *holes(4, [polar(20, 2 * PI * k / 5) for k in range(5)]))


def cam_plate():
    spiral = [polar(22 + 20 * (k / 60) ** 1.5, 2 * PI * k / 60) for k in range(60)]
    body = fuse(prism(spiral, 6), cylinder(11, 12))
    return cut(body, cylinder(5.5, 40, z=-5), turned(slot(14, 5, 30, x=22, z=-5), 4.4),
               cylinder(3, 30, *polar(17, 1.2), z=-5))


def hinge_leaf():
    body = block(60, 34, 2.5, y=19)
    for x in (-30, -6, 18):
        body = fuse(body, cylinder(5, 12, x=x, z=2.5, axis=(1, 0, 0)))
    body = cut(body, cylinder(2.6, 100, x=-50, z=2.5, axis=(1, 0, 0)))
    clearance = [box(x, -6, -4, 12, 12, 20) for x in (-18, 6)]
    return cut(body, *clearance, *holes(2.6, [(-20, 27), (0, 17), (20, 27)]))


def gasket():
    body = fuse(rounded_block(92, 52, 1.6, 14), cylinder(17, 1.6, x=38, y=24))
    openings = [rounded_block(44, 34, 10, 6, x=-18, z=-5), cylinder(15, 10, x=26, z=-5)]
    bolts = [(-40, 20), (-40, -20), (0, 22), (40, -20), (41, 29), (8, -22)]
    return cut(body, *openings, *holes(2.6, bolts))


def slotted_shim():
    body = rounded_block(70, 40, 1.2, 4)
    slots = [block(38, 9, 10, x=20, y=sy * 9, z=-5) for sy in (-1, 1)]
    return fuse(cut(body, *slots, cylinder(3, 10, x=-27, y=12, z=-5)),
                moved(turned(box(0, -20, 0, 14, 26, 1.2), -1.1, (0, 1, 0)), x=-35))


def bell_crank():
    arms = [turned(prism([(0, -8), (length, -5), (length, 5), (0, 8)], 7), angle)
            for length, angle in ((58, 0.0), (42, 1.9), (30, 3.6))]
    ends = [cylinder(9, height, *polar(length, angle))
            for length, angle, height in ((58, 0.0, 12), (42, 1.9, 7), (30, 3.6, 18))]
    body = fuse(cylinder(14, 20), *arms, *ends)
    return cut(body, cylinder(7, 50, z=-5), *holes(4, [polar(58, 0), polar(42, 1.9)]),
               cylinder(3, 60, *polar(30, 3.6), z=-5))


def connecting_rod():
    shank = prism([(0, -11), (88, -7), (88, 7), (0, 11)], 10, z=3)
    body = fuse(cylinder(25, 16), cylinder(13, 16, x=88), shank, block(16, 62, 16, x=0))
    pockets = [prism([(30, -5), (70, -3), (70, 3), (30, 5)], 3, z=z) for z in (3, 10)]
    body = cut(body, *pockets, cylinder(17, 40, z=-5), cylinder(7, 40, x=88, z=-5))
    return cut(body, *[cylinder(2.8, 40, x=-20, y=y, z=8, axis=(1, 0, 0)) for y in (-26, 26)])


def housing():
    body = rounded(block(78, 54, 36), 6, vertical)
    body = cut(body, rounded_block(68, 44, 31, 4))
    feet = [rounded_block(14, 14, 5, 4, x=sx * 42, y=sy * 20) for sx in (-1, 1) for sy in (-1, 1)]
    boss = cylinder(15, 12, x=10, z=34)
    ribs = [block(3, 8, 30, x=x, y=29) for x in (-22, 0, 22)]
    body = fuse(body, *feet, boss, *ribs)
    return cut(body, cylinder(9, 60, x=10), cylinder(7, 40, x=-60, z=16, axis=(1, 0, 0)),
               *holes(2.4, [(sx * 43, sy * 20) for sx in (-1, 1) for sy in (-1, 1)]))


def universal_cross():
    arms = [cylinder(9, 74, x=-37, axis=(1, 0, 0)), cylinder(9, 60, y=-30, axis=(0, 1, 0))]
    collars = [cylinder(12, 40, x=-20, axis=(1, 0, 0)), cylinder(12, 36, y=-18, axis=(0, 1, 0))]
    body = fuse(*arms, *collars, ball(17))
    return cut(body, cylinder(4, 50, z=2), block(40, 40, 10, z=-22))


def hose_nipple():
    barbs = [cone(11, 8.5, 7, z=22 + 7 * k) for k in range(4)]
    hexagon = prism([polar(18, 2 * PI * k / 6) for k in range(6)], 11, z=11)
    body = fuse(cylinder(12, 12), hexagon, cylinder(8.5, 52), *barbs)
    return cut(body, cylinder(5.5, 100, z=-10))


def spanner():
    body = fuse(prism([(0, -8), (98, -6), (98, 6), (0, 8)], 5), cylinder(19, 7, x=-6, z=-1),
                cylinder(13, 7, x=104, z=-1))
    jaw = moved(turned(box(-40, -8, -5, 42, 16, 20), 0.26), x=-2)
    ring_hole = moved(prism([polar(8, 2 * PI * k / 6) for k in range(6)], 30, z=-5), x=104)
    return cut(body, jaw, ring_hole, slot(50, 5, 2, x=48, z=4))


def serrated_block():
    steps = [(7 * k + dx, 8 + 4.5 * k + dz) for k in range(8) for dx, dz in ((0, 0), (0, 4.5))]
    body = turned(prism([(0, 0), *steps, (66, 44), (66, 0)], 26), PI / 2, (1, 0, 0))
    return cut(body, box(24, -20, -1, 20, 12, 8), slot(16, 8, 100, x=34, y=-13, z=-30),
               cylinder(4, 60, x=56, y=-40, z=20, axis=(0, 1, 0)))


def bearing_cage():
    body = ring(36, 33, 16)
    pockets = around(lambda: cylinder(5.6, 60, z=8, axis=(1, 0, 0)), 11)
    return cut(fuse(body, ring(36, 28, 1.6, z=0)), *pockets)


def motor_mount():
    body = fuse(rounded_block(62, 50, 2, 5), box(-31, -25, 0, 2, 50, 42),
                box(-31, 23, 0, 40, 2, 18))
    face_holes = [cylinder(radius, 20, x=-40, y=y, z=z, axis=(1, 0, 0))
                  for radius, y, z in ((11, 0, 24), (2, -15, 9), (2, 15, 39), (2, -15, 39))]
    slots = [slot(14, 4.5, 10, x=12, y=y, z=-5) for y in (-14, 12)]
    return cut(body, *face_holes, *slots)


def slot_profile():
    body = rounded_block(40, 40, 55, 2)
    for k in range(4):
        groove = fuse(block(8, 14, 80, y=20, z=-10), block(18, 6, 80, y=13, z=-10))
        body = cut(body, turned(groove, k * PI / 2))
    return cut(body, cylinder(3.4, 80, z=-10))


def pedestal():
    body = rounded(block(92, 30, 12), 8, vertical)
    bearing = cylinder(24, 30, y=-15, z=38, axis=(0, 1, 0))
    web = turned(prism([(-34, 0), (34, 0), (22, 46), (-22, 46)], 18), PI / 2, (1, 0, 0))
    body = fuse(body, bearing, moved(web, y=9), cylinder(6, 12, z=58))
    return cut(body, cylinder(14, 60, y=-30, z=38, axis=(0, 1, 0)), cylinder(2, 60, z=40),
               *[slot(5, 9, 40, x=x, z=-5) for x in (-36, 36)])


def wing_nut():
    hub = revolved([(5, 0), (12, 0), (9, 14), (5, 14)])
    wing = turned(prism([(7, 0), (24, 12), (30, 25), (24, 30), (15, 22), (7, 13)], 5), PI / 2,
                  (1, 0, 0))
    wings = [moved(wing, y=2.5)]
    wings.append(turned(occ.copy([wings[0]])[0], PI))
    return cut(fuse(hub, *wings), cylinder(5, 60, z=-10))


def snap_lid():
    loop = polyline([(x, y, 0) for x, y in
                     [(-38, -20), (20, -20), (38, -4), (38, 20), (-10, 20), (-38, 8)]])
    body = rounded(extruded(plane(loop), 14), 5, vertical)
    cavity = prism([(-34, -16), (18, -16), (34, -3), (34, 16), (-9, 16), (-34, 5)], 11.5)
    hooks = [box(-8, -21.5, -6, 10, 3, 12), box(10, 19, -6, 8, 2.5, 12)]
    grille = [box(-26 + 7 * k, -8, 0, 3, 18, 40) for k in range(5)]
    return cut(fuse(cut(body, cavity), *hooks), *grille)


SHAPES = [angle_bracket, pipe_flange, manifold, cover, star_knob, hand_lever, saddle_clamp,
          v_pulley, impeller, spring_clip, elbow, rod_end, clevis, heat_sink, spur_gear, cam_plate,
          hinge_leaf, gasket, slotted_shim, bell_crank, connecting_rod, housing, universal_cross,
          hose_nipple, spanner, serrated_block, bearing_cage, motor_mount, slot_profile, pedestal,
          wing_nut, snap_lid]
