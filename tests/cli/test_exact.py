# SPDX-License-Identifier: GPL-3.0-or-later
"""`sphverify exact` against formulas that this test computes itself."""

import sys

sys.dont_write_bytecode = True

import itertools
import math
import re
import unittest

from program import ProgramTest, strict_json

PI = math.pi
NINE_CASES = [
    "operator/polynomial", "operator/sine", "conduction/slab-dirichlet", "conduction/slab-insulated",
    "conduction/slab-flux", "conduction/half-space-step", "conduction/manufactured", "conduction/barenblatt",
    "conduction/marshak",
]  # fmt: skip


def ierfc(z):
    return math.exp(-z * z) / math.sqrt(PI) - z * math.erfc(z)


def marshak_profile(n, steps=4000):
    """Solves (f^n f')' = -xi f'/2 from the front inwards and scales it to f(0) = 1.

    Gives the front and a list of (xi, f). With the front at 1 and eta = 1 - xi: p = f^n and s = f^(n-1) f' obey
    p' = n s, s' = -(xi/2 + s) s/p, and s = -1/2 + eta/(2(n+1)) + ..., so that ln(eta) is the variable to step in.
    """
    start = 1e-7
    s = -0.5 + start / (2 * (n + 1))
    p = n * start / 2 - n * start**2 / (4 * (n + 1))

    def rates(y, p, s):  # by y = ln(eta); d/dxi = -d/d(eta)
        eta = math.exp(y)
        return -eta * n * s, eta * (0.5 * (1 - eta) + s) * s / p

    y, h = math.log(start), -math.log(start) / steps
    points = [(y, p)]
    for _ in range(steps):
        a = rates(y, p, s)
        b = rates(y + h / 2, p + h / 2 * a[0], s + h / 2 * a[1])
        c = rates(y + h / 2, p + h / 2 * b[0], s + h / 2 * b[1])
        d = rates(y + h, p + h * c[0], s + h * c[1])
        p += h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
        s += h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
        y += h
        points.append((y, p))
    at_wall = p ** (1 / n)
    front = at_wall ** (-n / 2)
    return front, [(front * -math.expm1(min(y, 0)), q ** (1 / n) / at_wall) for y, q in points]


class Exact(ProgramTest):
    def exact(self, case, time, points, *parameters):
        arguments = [word for parameter in parameters for word in ("--parameter", parameter)]
        points = points if isinstance(points, str) else ",".join(repr(x) for x in points)
        document = strict_json(self.succeed("exact", case, *arguments, "--time", repr(time), f"--points={points}"))
        self.assertEqual(document["case"], case)
        count = points.count(",") + 1
        for field, values in document["fields"].items():
            self.assertEqual(len(values), count, field)
        return document

    def assert_near(self, found, expected, tolerance=1e-12):
        self.assertEqual(len(found), len(expected))
        for f, e in zip(found, expected):
            self.assertLessEqual(abs(f - e), tolerance * max(1.0, abs(e)), f"{found} instead of {expected}")

    def temperature(self, *arguments):
        return self.exact(*arguments)["fields"]["temperature"]


class Coverage(Exact):
    def points_of(self, case):
        """Two points with as many coordinates as the case has by its defaults, which a refusal of one says."""
        result = self.run_program("exact", case, "--time", "0.01", "--points", "0.25")
        wanted = re.search(r"(\d) coordinates per point", result.stderr)
        count = int(wanted[1]) if wanted else 1
        return ",".join(":".join([x] * count) for x in ("0.25", "0.5"))

    def test_every_case_of_the_list_has_a_reference_solution_with_its_defaults(self):
        cases = [entry["id"] for entry in strict_json(self.succeed("list", "cases", "--json"))["cases"]]
        self.assertTrue(set(NINE_CASES) <= set(cases), cases)
        for case in cases:
            with self.subTest(case=case):
                document = self.exact(case, 0.01, self.points_of(case))
                self.assertTrue(document["fields"])
                self.assertTrue(set(document) >= {"fields", "parameters", "time", "case", "schema"})
                for values in document["fields"].values():
                    self.assertNotIn(None, [c for v in values for c in (v if isinstance(v, list) else [v])])


class Operators(Exact):
    POINTS = [0.0, 0.125, 0.3, 1.0]

    def check(self, case, parameters, f, slope, curvature):
        fields = self.exact(case, 0.0, self.POINTS, *parameters)["fields"]
        self.assert_near(fields["density"], [1.0] * 4)
        for name in ("pressure", "temperature"):
            self.assert_near(fields[name], [f(x) for x in self.POINTS])
        for name, function in (("velocity", f), ("flux", lambda x: -slope(x)), ("acceleration", lambda x: -slope(x))):
            self.assertEqual({len(v) for v in fields[name]}, {1})
            self.assert_near([v[0] for v in fields[name]], [function(x) for x in self.POINTS])
        self.assert_near(fields["heating"], [curvature(x) for x in self.POINTS])

    def test_polynomials_and_their_rates(self):
        for d in (0, 1, 2, 5):
            with self.subTest(degree=d):
                self.check(
                    "operator/polynomial", [f"degree={d}"], lambda x: x**d + 1,
                    lambda x: d * x ** (d - 1) if d else 0.0, lambda x: d * (d - 1) * x ** (d - 2) if d > 1 else 0.0,
                )  # fmt: skip

    def test_sine_and_its_rates(self):
        self.check("operator/sine", [], lambda x: 2 + math.sin(3 * x + 0.3), lambda x: 3 * math.cos(3 * x + 0.3),
                   lambda x: -9 * math.sin(3 * x + 0.3))  # fmt: skip
        self.check("operator/sine", ["wavenumber=7.5", "phase=-1", "offset=4"],
                   lambda x: 4 + math.sin(7.5 * x - 1), lambda x: 7.5 * math.cos(7.5 * x - 1),
                   lambda x: -7.5**2 * math.sin(7.5 * x - 1))  # fmt: skip

    def test_points_and_vectors_in_2d_and_3d(self):
        fields = self.exact("operator/polynomial", 0.0, "0.5:0.1,0.25:0.9", "degree=2", "dimension=2")["fields"]
        self.assert_near(fields["pressure"], [1.25, 1.0625])
        self.assertEqual(fields["velocity"], [[1.25, 0.0], [1.0625, 0.0]])
        self.assertEqual([[abs(c) for c in v] for v in fields["acceleration"]], [[1.0, 0.0], [0.5, 0.0]])
        fields = self.exact("operator/polynomial", 0.0, "0.5:0.1:0.2", "degree=2", "dimension=3")["fields"]
        self.assertEqual(fields["velocity"], [[1.25, 0.0, 0.0]])


class Slabs(Exact):
    POINTS = [0.0, 0.1, 0.5, 0.75, 1.0]

    def test_slab_dirichlet_is_the_sum_of_its_modes(self):
        def expected(x, t, kappa=1.0, left=1.0, right=2.0, modes=((1, 1.0), (3, 0.5))):
            return left + (right - left) * x + sum(
                a * math.sin(n * PI * x) * math.exp(-((n * PI) ** 2) * kappa * t) for n, a in modes
            )  # fmt: skip

        for t in (0.0, 0.013, 0.05, 2.0):
            found = self.temperature("conduction/slab-dirichlet", t, self.POINTS)
            self.assert_near(found, [expected(x, t) for x in self.POINTS])
        found = self.temperature(
            "conduction/slab-dirichlet", 0.02, self.POINTS,
            "left=3", "right=-1", "modes=[[2, 0.25], [5, -1]]", "conductivity=0.5", "density=2",
        )  # fmt: skip
        self.assert_near(
            found, [expected(x, 0.02, 0.25, 3.0, -1.0, ((2, 0.25), (5, -1.0))) for x in self.POINTS]
        )

    def test_slab_dirichlet_flux_is_fourier_s_law(self):
        flux = self.exact("conduction/slab-dirichlet", 0.05, [0.0], "modes=[[1,1]]", "conductivity=2")["fields"]["flux"]
        self.assert_near(flux[0], [-2 * (1 + PI * math.exp(-(PI**2) * 2 * 0.05))])

    def test_slab_insulated_is_the_sum_of_its_modes_and_passes_no_heat(self):
        for t in (0.0, 0.05):
            fields = self.exact("conduction/slab-insulated", t, self.POINTS, "mean=4", "modes=[[1, 0.5], [4, 2]]",
                                "density=3")["fields"]  # fmt: skip
            self.assert_near(fields["temperature"], [
                4 + 0.5 * math.cos(PI * x) * math.exp(-(PI**2) * t / 3)
                + 2 * math.cos(4 * PI * x) * math.exp(-((4 * PI) ** 2) * t / 3)
                for x in self.POINTS
            ])  # fmt: skip
            for wall in (0, -1):
                self.assertLess(abs(fields["flux"][wall][0]), 1e-12)

    def test_slab_flux_is_the_series_of_images_early_and_of_cosines_late(self):
        def images(x, kt):
            r = 2 * math.sqrt(kt)
            return r * sum(ierfc((2 * m + x) / r) + ierfc((2 * m + 2 - x) / r) for m in range(60))

        def cosines(x, kt):
            return kt + 0.5 * (1 - x) ** 2 - 1 / 6 - 2 / PI**2 * sum(
                math.exp(-((n * PI) ** 2) * kt) * math.cos(n * PI * x) / n**2 for n in range(1, 400)
            )  # fmt: skip

        for t in (0.001, 0.05, 0.099, 0.101, 0.3, 2.0):
            with self.subTest(t=t):
                expected = [images(x, t) if t < 0.2 else cosines(x, t) for x in self.POINTS]
                found = self.temperature("conduction/slab-flux", t, self.POINTS)
                self.assert_near(found, [1 + e for e in expected])
                found = self.temperature("conduction/slab-flux", t, self.POINTS, "flux=3", "initial=-2",
                                         "conductivity=2", "density=2")  # fmt: skip
                self.assert_near(found, [-2 + 3 / 2 * e for e in expected])
        start = self.temperature("conduction/slab-flux", 0.0, self.POINTS)
        self.assert_near(start, [1.0] * 5)

    def test_slab_flux_prescribes_its_fluxes(self):
        flux = self.exact("conduction/slab-flux", 0.03, [0.0, 1.0], "flux=2.5")["fields"]["flux"]
        self.assert_near(flux[0], [2.5])
        self.assert_near(flux[1], [0.0])

    def test_half_space_step_is_the_complementary_error_function(self):
        for t in (1e-4, 0.05, 1.0):
            found = self.temperature("conduction/half-space-step", t, self.POINTS)
            self.assert_near(found, [math.erfc(x / (2 * math.sqrt(t))) for x in self.POINTS])
        found = self.temperature("conduction/half-space-step", 0.1, self.POINTS, "wall=5", "initial=2",
                                 "conductivity=0.5", "density=4")  # fmt: skip
        self.assert_near(found, [2 + 3 * math.erfc(x / (2 * math.sqrt(0.1 / 8))) for x in self.POINTS])

    def test_the_infinite_flux_of_a_step_at_time_zero_is_null(self):
        fields = self.exact("conduction/half-space-step", 0.0, [0.0, 0.5])["fields"]
        self.assertIsNone(fields["flux"][0][0])
        self.assertEqual(fields["flux"][1], [0.0])
        self.assert_near(fields["temperature"], [1.0, 0.0])


    def test_slabs_in_2d_and_3d_are_the_slab_of_one_dimension(self):
        for case in ("slab-dirichlet", "slab-insulated", "slab-flux", "half-space-step"):
            line = self.exact(f"conduction/{case}", 0.03, self.POINTS)["fields"]
            for dimension, others in ((2, ":0.3"), (3, ":0.3:0.9")):
                with self.subTest(case=case, dimension=dimension):
                    points = ",".join(f"{x}{others}" for x in self.POINTS)
                    fields = self.exact(f"conduction/{case}", 0.03, points, f"dimension={dimension}")["fields"]
                    self.assertEqual(fields["temperature"], line["temperature"])
                    expected = [flux + [0.0] * (dimension - 1) for flux in line["flux"]]
                    self.assertEqual(fields["flux"], expected)

    def test_a_turned_slab_has_the_temperatures_and_the_turned_fluxes_of_the_straight_one(self):
        c, s = math.cos(PI / 6), math.sin(PI / 6)
        rotations = {  # columns: where the axes come to lie, in 3D about z and then about x
            2: ((c, -s), (s, c)),
            3: ((c, -s, 0), (c * s, c * c, -s), (s * s, c * s, c)),
        }  # fmt: skip
        for dimension, R in rotations.items():
            straight = [point[:dimension] for point in ((0.9, 0.3, 0.1), (0.6, 0.5, 0.4), (0.75, 0.2, 0.6))]
            turned = [[sum(r * x for r, x in zip(row, point)) for row in R] for point in straight]
            with self.subTest(dimension=dimension):
                found, expected = (
                    self.exact(
                        "conduction/slab-dirichlet", 0.02, ",".join(":".join(map(repr, x)) for x in points),
                        f"dimension={dimension}", f"turn={turn}",
                    )["fields"]
                    for points, turn in ((turned, 30), (straight, 0))
                )  # fmt: skip
                self.assert_near(found["temperature"], expected["temperature"])
                for flux, old in zip(found["flux"], expected["flux"]):
                    self.assert_near(flux, [sum(r * f for r, f in zip(row, old)) for row in R])

    def test_a_slab_in_one_dimension_cannot_be_turned(self):
        result = self.run_program("exact", "conduction/slab-dirichlet", "--parameter", "turn=30", "--time", "0",
                                  "--points", "0.5")  # fmt: skip
        self.assert_user_error(result, "expected 0 in one dimension", "found 30")


class Boxes(Exact):
    GRID = [0.0, 0.1, 0.5, 0.7, 1.0]

    @staticmethod
    def series(point, t, kappa, left, right, modes, sideways):
        """Temperature, and its gradient, of the sum of products: sines along x, `sideways` along the other axes."""
        slopes = {math.sin: math.cos, math.cos: lambda phase: -math.sin(phase)}
        temperature = left + (right - left) * point[0]
        gradient = [right - left] + [0.0] * (len(point) - 1)
        for *numbers, amplitude in modes:
            waves = [math.sin] + [sideways] * (len(point) - 1)
            phases = [n * PI * x for n, x in zip(numbers, point)]
            size = amplitude * math.exp(-sum(n * n for n in numbers) * PI**2 * kappa * t)
            temperature += size * math.prod(wave(phase) for wave, phase in zip(waves, phases))
            for k in range(len(point)):
                gradient[k] += size * numbers[k] * PI * math.prod(
                    (slopes[wave] if j == k else wave)(phase) for j, (wave, phase) in enumerate(zip(waves, phases))
                )  # fmt: skip
        return temperature, gradient

    def test_square_and_cube_are_the_sum_of_their_products(self):
        defaults = {"square": [[1, 1, 1], [3, 2, 0.5]], "cube": [[1, 1, 1, 1], [2, 1, 3, 0.5]]}
        others = {"square": [[2, 4, -0.25]], "cube": [[1, 2, 1, 0.75], [3, 1, 2, -0.5]]}
        for (name, dimension), (walls, wave) in itertools.product(
            (("square", 2), ("cube", 3)), (("dirichlet", math.sin), ("mixed", math.cos))
        ):  # fmt: skip
            points = list(itertools.product(self.GRID, repeat=dimension))
            text = ",".join(":".join(map(repr, point)) for point in points)
            for t, kappa, left, right, modes, parameters in (
                (0.0, 1.0, 1.0, 2.0, defaults[name], []),
                (0.02, 1.0, 1.0, 2.0, defaults[name], []),
                (0.03, 0.25, -1.0, 3.0, others[name],
                 ["left=-1", "right=3", f"modes={others[name]}", "conductivity=0.5", "density=2"]),
            ):  # fmt: skip
                with self.subTest(case=name, walls=walls, t=t):
                    fields = self.exact(f"conduction/{name}", t, text, f"walls={walls}", *parameters)["fields"]
                    conductivity = 0.5 if parameters else 1.0
                    expected = [self.series(point, t, kappa, left, right, modes, wave) for point in points]
                    self.assert_near(fields["temperature"], [temperature for temperature, _ in expected])
                    for flux, (_, gradient) in zip(fields["flux"], expected):
                        self.assert_near(flux, [-conductivity * slope for slope in gradient])

    def test_insulated_sides_pass_no_heat_and_the_others_keep_their_temperatures(self):
        corners = list(itertools.product((0.0, 1.0), repeat=3))
        text = ",".join(":".join(map(repr, point)) for point in corners)
        for t in (0.0, 0.01):
            fields = self.exact("conduction/cube", t, text, "walls=mixed", "left=4", "right=-2")["fields"]
            self.assert_near(fields["temperature"], [4.0 if x == 0.0 else -2.0 for x, _, _ in corners])
            for flux in fields["flux"]:
                self.assertLess(max(abs(flux[1]), abs(flux[2])), 1e-14)

    def test_bad_modes_and_walls_are_refused(self):
        for case, parameter, words in (
            ("square", "modes=[[1,1]]", ["[n, m, amplitude]"]),
            ("cube", "modes=[[1,1,1]]", ["[n, m, l, amplitude]"]),
            ("square", "modes=[[1,1.5,1]]", ["whole"]),
            ("square", "modes=[[1,0,1]]", ["--parameter modes[0][1]: found 0, expected a whole number"]),
            ("square", "walls=open", ["--parameter walls: found 'open', expected one of dirichlet, mixed"]),
        ):  # fmt: skip
            with self.subTest(case=case, parameter=parameter):
                points = ":".join(["0.5"] * (2 if case == "square" else 3))
                result = self.run_program("exact", f"conduction/{case}", "--parameter", parameter, "--time", "0",
                                          "--points", points)  # fmt: skip
                self.assert_user_error(result, *words)


class Pistons(Exact):
    def test_pistons_and_uniform_gas_in_2d_and_3d_are_those_of_one_dimension(self):
        line_points = [0.05, 0.3, 0.45, 0.9]
        for case in ("piston-velocity", "piston-pressure", "uniform"):
            line = self.exact(f"hydro/{case}", 0.3, line_points)["fields"]
            for dimension, others in ((2, ":0.1"), (3, ":0.1:0.2")):
                with self.subTest(case=case, dimension=dimension):
                    points = ",".join(f"{x}{others}" for x in line_points)
                    fields = self.exact(f"hydro/{case}", 0.3, points, f"dimension={dimension}")["fields"]
                    for name in ("density", "pressure", "internal_energy"):
                        self.assertEqual(fields[name], line[name])
                    self.assertEqual(fields["velocity"], [v + [0.0] * (dimension - 1) for v in line["velocity"]])


class Manufactured(Exact):
    def test_fields_have_the_shape_that_describe_states(self):
        points = [0.0, 0.2, 0.6, 1.0]
        at = {t: self.temperature("conduction/manufactured", t, points) for t in (0.0, 0.7)}
        for k, x in enumerate(points):
            early, late = (at[t][k] - 2 - 0.6 * x for t in (0.0, 0.7))
            self.assertLessEqual(abs(early), 0.5)
            self.assertAlmostEqual(late / early, (1 + math.exp(-0.7)) / 2, places=12)
        density = self.exact("conduction/manufactured", 0.0, points)["fields"]["density"]
        self.assertTrue(all(0.99 < rho < 1.61 for rho in density), density)
        self.assertGreater(max(density) - min(density), 0.1)

    def test_flux_is_fourier_s_law_with_a_conductivity_in_its_bounds(self):
        for dimension, point in ((1, (0.4,)), (2, (0.4, 0.3)), (3, (0.4, 0.3, 0.8))):
            with self.subTest(dimension=dimension):
                step = 1e-5
                points = [point]
                for k in range(dimension):
                    for sign in (1, -1):
                        points.append(tuple(x + sign * step * (j == k) for j, x in enumerate(point)))
                text = ",".join(":".join(map(repr, p)) for p in points)
                fields = self.exact("conduction/manufactured", 0.1, text, f"dimension={dimension}", "conductivity=2")[
                    "fields"
                ]
                T = fields["temperature"]
                gradient = [(T[1 + 2 * k] - T[2 + 2 * k]) / (2 * step) for k in range(dimension)]
                conductivity = [-f / g for f, g in zip(fields["flux"][0], gradient)]
                for K in conductivity:
                    self.assertAlmostEqual(K, conductivity[0], delta=1e-7 * K)
                shape = 2 * (0.5 + T[0] ** 2 / 10)
                self.assertTrue(0.7 * shape <= conductivity[0] <= 1.3 * shape, conductivity)

    def test_other_axes_are_periodic(self):
        fields = self.exact("conduction/manufactured", 0.1, "0.4:0.0,0.4:1.0", "dimension=2")["fields"]
        self.assert_near([fields["temperature"][0]], [fields["temperature"][1]])
        self.assert_near(fields["flux"][0], fields["flux"][1])


class Fronts(Exact):
    def test_barenblatt_is_its_compact_formula_with_times_counted_from_the_start(self):
        for m, constant, start in ((2.0, 1.0, 1.0), (3.0, 0.5, 2.0), (1.5, 1.0, 0.5)):
            for t in (0.0, 0.4):
                with self.subTest(m=m, t=t):
                    age, a = start + t, 1 / (m + 1)
                    k = (m - 1) / (2 * m * (m + 1))
                    points = [-5.0, -1.0, 0.0, 0.5, 2.0, 5.9]
                    expected = [
                        age**-a * max(constant - k * x * x * age ** (-2 * a), 0) ** (1 / (m - 1)) for x in points
                    ]
                    document = self.exact("conduction/barenblatt", t, points, f"exponent={m}", f"constant={constant}",
                                          f"start_time={start}", "half_width=9")  # fmt: skip
                    self.assert_near(document["fields"]["temperature"], expected)
                    self.assertAlmostEqual(document["front"], math.sqrt(constant / k) * age**a, places=12)

    def test_barenblatt_keeps_its_heat(self):
        points = [-6 + 12 * (k + 0.5) / 2000 for k in range(2000)]
        heat = [sum(self.temperature("conduction/barenblatt", t, points)) for t in (0.0, 1.0)]
        self.assertAlmostEqual(heat[1] / heat[0], 1.0, places=6)

    def test_marshak_front_of_exponent_3_is_the_known_constant(self):
        for t in (0.01, 0.5):
            front = self.exact("conduction/marshak", t, [0.0], "exponent=3")["front"]
            self.assertAlmostEqual(front / math.sqrt(t), 0.870570756, delta=2e-9)

    def test_marshak_front_and_profile_solve_its_equation_for_every_exponent(self):
        for n in (1.0, 3.0, 6.5):
            with self.subTest(n=n):
                front, profile = marshak_profile(n)
                t = 0.04
                chosen = [point for point in profile[1000::600] if point[0] >= 0]
                self.assertGreater(len(chosen), 4)
                points = [xi * math.sqrt(t) for xi, _ in chosen]
                document = self.exact("conduction/marshak", t, points, f"exponent={n}")
                self.assertAlmostEqual(document["front"] / math.sqrt(t), front, delta=1e-8)
                self.assert_near(document["fields"]["temperature"], [f for _, f in chosen], 1e-6)

    def test_marshak_is_cold_and_still_ahead_of_its_front(self):
        document = self.exact("conduction/marshak", 0.25, [0.5, 0.99])
        self.assertLess(document["front"], 0.5)
        self.assertEqual(document["fields"]["temperature"], [0.0, 0.0])
        self.assertEqual(document["fields"]["flux"], [[0.0], [0.0]])

    def test_marshak_at_time_zero_has_its_front_at_the_wall_and_an_infinite_flux_that_is_null(self):
        document = self.exact("conduction/marshak", 0.0, [0.0, 0.5])
        self.assertEqual(document["front"], 0.0)
        self.assertEqual(document["fields"]["temperature"], [1.0, 0.0])
        self.assertEqual(document["fields"]["flux"], [[None], [0.0]])


class Arguments(Exact):
    def test_parameters_come_as_json_numbers_and_lists_and_are_reported_with_the_defaults(self):
        parameters = self.exact("conduction/slab-dirichlet", 0.0, [0.5], "left=-2.5e-1", "modes=[[2, 1]]")["parameters"]
        self.assertEqual(parameters, {"dimension": 1, "left": -0.25, "right": 2, "modes": [[2, 1]], "conductivity": 1,
                                      "density": 1, "turn": 0, "final_time": 0.05})  # fmt: skip

    def test_an_empty_list_of_modes_leaves_the_steady_state(self):
        self.assert_near(self.temperature("conduction/slab-dirichlet", 0.01, [0.25], "modes=[]"), [1.25])

    def test_negative_points_and_exponents_are_read(self):
        points = "-1,-1e0,-0.1E1"
        found = self.temperature("conduction/barenblatt", 0.5, points)
        self.assertEqual(len(set(found)), 1)

    def refuse(self, words, case, *arguments):
        self.assert_user_error(self.run_program("exact", case, *arguments), *words)

    def test_a_bare_word_is_taken_as_a_word_and_refused_where_a_number_is_wanted(self):
        self.refuse(["exponent", "found 'three'", "a number"], "conduction/marshak",
                    "--parameter", "exponent=three", "--time", "1", "--points", "0")  # fmt: skip

    def test_a_parameter_without_effect_is_refused(self):
        self.refuse(["gamma: found 1.6666", "no effect"], "hydro/riemann", "--parameter", "preset=sod", "--parameter", "gamma=1.6666",
                    "--time", "0.1", "--points", "0.5")  # fmt: skip
        self.refuse(["preset: found 'sod'", "no effect"], "hydro/riemann", "--parameter", "preset=sod", "--parameter",
                    "left=[1,0,1]", "--parameter", "right=[1,0,2]", "--time", "0.1", "--points", "0.5")  # fmt: skip
        self.refuse(["'exponent=2'", "only once"], "conduction/marshak", "--parameter", "exponent=3", "--parameter",
                    "exponent=2", "--time", "0.1", "--points", "0.5")  # fmt: skip
        self.assertNotIn("gamma", self.exact("hydro/riemann", 0.1, [0.5], "preset=leblanc")["parameters"])

    def test_the_asked_time_is_judged_and_not_a_default_that_nobody_asked_for(self):
        for case, parameter, early, late in (("hydro/noh", "gamma=2.9", 0.1, 0.6),
                                             ("conduction/marshak", "exponent=1", 0.1, 0.5),
                                             ("conduction/barenblatt", "half_width=3.8", 0.1, 1.0)):  # fmt: skip
            with self.subTest(case=case):
                for time in (0.0, early):
                    self.exact(case, time, [0.25], parameter)
                self.assertEqual(self.exact(case, early, [0.25], parameter)["parameters"]["final_time"], early)
                self.refuse([case], case, "--parameter", parameter, "--time", str(late), "--points", "0.25")

    def test_bad_points_are_refused(self):
        for points, word in (("", "--points"), ("0,,1", "''"), ("0,", "''"), ("x", "'x'"), ("0.1:0.2", "1 coordinate"),
                             ("nan", "'nan'"), ("inf", "'inf'"), ("1e999", "'1e999'"), ("0 0.5", "'0 0.5'"),
                             ("2", "domain"), ("-0.1", "domain")):  # fmt: skip
            with self.subTest(points=points):
                self.refuse(["--points", word], "conduction/marshak", "--time", "0.1", f"--points={points}")
        for points in ("0.5", "0.5:0.5:0.5", "0.5:"):
            with self.subTest(points=points):
                self.refuse(["--points"], "conduction/manufactured", "--parameter", "dimension=2", "--time", "0",
                            f"--points={points}")  # fmt: skip

    def test_bad_times_are_refused(self):
        for time in ("-1", "nan", "inf", "soon", ""):
            with self.subTest(time=time):
                self.refuse(["--time"], "conduction/marshak", f"--time={time}", "--points", "0")

    def test_bad_parameters_are_refused(self):
        for parameter, word in (("exponent", "NAME=VALUE"), ("expnent=3", "did you mean 'exponent'?"),
                                ("exponent=-3", "exponent"), ("exponent=[3]", "found a list"),
                                ("exponent=1e999", "exponent"), ("exponent=", "exponent"),
                                ("=3", "expected")):  # fmt: skip
            with self.subTest(parameter=parameter):
                self.refuse([word], "conduction/marshak", "--parameter", parameter, "--time", "1", "--points", "0")

    def test_an_unknown_case_is_refused_with_the_nearest_one(self):
        self.refuse(["did you mean 'conduction/marshak'?"], "conduction/marshack", "--time", "1", "--points", "0")


if __name__ == "__main__":
    unittest.main(verbosity=2)
