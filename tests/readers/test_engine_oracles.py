"""Torsional vibration and slider-crank forces, computed again by other programs.

The example `oracles` of the crate sommerfeld-engine prints what it computed and from what. openTorsion
and a complex solve with numpy repeat the vibration, Exudyn, a multibody program, the slider-crank.
"""

import csv
import json
import subprocess

import exudyn
import numpy as np
import opentorsion
import pytest
from conftest import ROOT
from exudyn import itemInterface as items

# Bars of the acceptance: forced response, slider-crank forces over the peak of each.
RESPONSE = 1e-6
FORCES = 1e-3


@pytest.fixture(scope="module")
def oracles():
    command = ["cargo", "run", "--quiet", "--locked", "--package", "sommerfeld-engine"]
    ended = subprocess.run(
        [*command, "--example", "oracles"], cwd=ROOT, capture_output=True, text=True
    )
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)


def amplitudes(harmonics):
    """Complex amplitudes of the orders above 0, by order."""
    return {one["order"]: one["cos"] - 1j * one["sin"] for one in harmonics if one["order"] > 0}


def by_order(courses):
    """The orders, and the amplitudes of all courses: a row for each of them."""
    tables = [amplitudes(course["harmonics"]) for course in courses]
    orders = sorted(tables[0])
    assert orders[0] == 0.5 and orders[-1] == 12.0
    return np.array(orders), np.array([[table[order] for order in orders] for table in tables])


def torques_on_discs(case, orders):
    discs = case["chain"]["discs"]
    torques = np.zeros((len(discs), len(orders)), dtype=complex)
    for row, disc in zip(torques, discs):
        if disc["throw"] is not None:
            given = amplitudes(case["torques"][disc["throw"]])
            row[:] = [given[order] for order in orders]
    return torques


def assembly(chain):
    """The chain in openTorsion."""
    shafts = [
        opentorsion.Shaft(at, at + 1, k=link["stiffness"], c=link["damping"])
        for at, link in enumerate(chain["links"])
    ]
    disks = [
        opentorsion.Disk(at, I=disc["inertia"], c=disc["damping"])
        for at, disc in enumerate(chain["discs"])
    ]
    return opentorsion.Assembly(shafts, disk_elements=disks)


def frequencies(chain):
    values, _ = assembly(chain).undamped_modal_analysis()
    return np.sort(np.sqrt(np.abs(values))) / (2 * np.pi)


def difference(found, expected):
    """Largest difference over the largest value of each column."""
    return np.max(np.abs(found - expected) / np.max(np.abs(expected), axis=0))


def test_natural_frequencies_are_those_of_opentorsion(oracles):
    for case in oracles["torsion"]:
        found = np.array(case["response"]["natural_frequencies"])
        expected = frequencies(case["chain"])
        # Where ours is 0 an eigenvalue solver leaves the root of its rounding.
        assert np.all(expected[found == 0] < 1e-2)
        elastic = found > 0
        assert np.max(np.abs(found[elastic] / expected[elastic] - 1)) < 1e-8


def test_opentorsion_gives_the_frequencies_of_the_validation_case(oracles):
    with open(ROOT / "validation/torsion-i6/reference.csv", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        printed = [row["value"] for row in rows if row["quantity"] == "frequency"]
    plain = next(case for case in oracles["torsion"] if case["name"] == "plain")
    found = frequencies(plain["chain"])
    assert len(printed) == 6
    for text, value in list(zip(printed, found))[1:]:
        decimals = len(text.partition(".")[2])
        assert f"{value:.{decimals}f}" == text


def test_forced_response_is_that_of_opentorsion(oracles):
    for case in oracles["torsion"]:
        chain, response = case["chain"], case["response"]
        orders, found = by_order(response["twists"])
        omegas = orders * case["speed"]
        torques = torques_on_discs(case, orders)
        model = assembly(chain)
        excitation = opentorsion.PeriodicExcitation(model.dofs, omegas)
        for node, row in enumerate(torques):
            excitation.add_sines(node, omegas, np.abs(row), np.angle(row))

        def damping(omega):
            matrix = model.C.copy()
            for shaft, link in zip(model.shaft_elements, chain["links"]):
                places = np.ix_([shaft.nl, shaft.nr], [shaft.nl, shaft.nr])
                matrix[places] += link["loss_factor"] / omega * shaft.K()
            return matrix

        expected, _ = model.ss_response(excitation.U, omegas, C_func=damping)
        assert difference(found, expected) < RESPONSE, case["name"]

        # What the links pass on and turn into heat, from those twists.
        _, passed = by_order(response["link_torques"])
        stiffness = np.array(
            [
                link["stiffness"] * (1 + 1j * link["loss_factor"]) + 1j * omegas * link["damping"]
                for link in chain["links"]
            ]
        )
        across = expected[:-1] - expected[1:]
        assert difference(passed, stiffness * across) < RESPONSE, case["name"]
        heat = np.sum(0.5 * omegas * stiffness.imag * np.abs(across) ** 2, axis=1)
        assert difference(np.array(response["link_heat"]), heat) < RESPONSE, case["name"]


def test_forced_response_is_that_of_a_complex_solve(oracles):
    for case in oracles["torsion"]:
        chain = case["chain"]
        orders, found = by_order(case["response"]["twists"])
        torques = torques_on_discs(case, orders)
        discs = chain["discs"]
        expected = np.empty_like(found)
        for column, order in enumerate(orders):
            omega = order * case["speed"]
            matrix = np.diag(
                [1j * omega * disc["damping"] - omega**2 * disc["inertia"] for disc in discs]
            )
            for at, link in enumerate(chain["links"]):
                pull = link["stiffness"] * (1 + 1j * link["loss_factor"])
                pull += 1j * omega * link["damping"]
                matrix[at : at + 2, at : at + 2] += pull * np.array([[1, -1], [-1, 1]])
            expected[:, column] = np.linalg.solve(matrix, torques[:, column])
        assert difference(found, expected) < RESPONSE, case["name"]


class SliderCrank:
    """One cylinder as three plane bodies and joints in Exudyn, its crank turned as given.

    The run begins a quarter turn before the cycle: by then the integrator has forgotten how it began.
    """

    LEAD_IN = 0.5 * np.pi
    STEP = np.deg2rad(0.5)

    def __init__(self, data, motion):
        train = data["train"]
        self.radius, self.length = train["crank_radius"], train["rod_length"]
        self.offset, self.train = train["pin_offset"], train
        self.area = 0.25 * np.pi * train["bore"] ** 2
        self.diagram = np.array(data["diagram"])
        self.speed = motion["speed"]
        stations = motion["twists"]
        self.twist = stations[0][1]["harmonics"] if stations else []

    def arm(self, crank_angle):
        """Angle of the arm, and its slope over the crank angle."""
        angle, slope = crank_angle, 1.0
        for one in self.twist:
            order = one["order"]
            cos, sin = np.cos(order * crank_angle), np.sin(order * crank_angle)
            angle = angle + one["cos"] * cos + one["sin"] * sin
            slope = slope + order * (one["sin"] * cos - one["cos"] * sin)
        return angle, slope

    def gas_force(self, arm):
        dead_centre = np.arcsin(self.offset / (self.radius + self.length))
        angles, pressures = self.diagram.T
        pressure = np.interp(arm - dead_centre, angles, pressures, period=4 * np.pi)
        return self.area * (pressure - self.train["crankcase_pressure"])

    def body(self, system, mass, inertia, position, velocity):
        node = system.AddNode(
            items.NodeRigidBody2D(referenceCoordinates=position, initialVelocities=velocity)
        )
        body = items.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node)
        return node, system.AddObject(body)

    def run(self):
        """Crank angles and, in the frame of the cylinder: force of the rod on the pin, on the piston,
        side thrust on the piston, torque on the crank."""
        system = exudyn.SystemContainer().AddSystem()
        radius, length, rod = self.radius, self.length, self.train["rod"]
        gravity = rod["centre_of_gravity"]
        start, slope = self.arm(-self.LEAD_IN)
        turn = self.speed * slope
        lean = np.arcsin((radius * np.sin(start) - self.offset) / length)
        rod_turn = -radius * turn * np.cos(start) / (length * np.cos(lean))
        along, across = np.cos(lean), -np.sin(lean)
        pin = radius * np.array([np.cos(start), np.sin(start)])
        pin_speed = turn * np.array([-pin[1], pin[0]])

        def on_rod(distance):
            place = pin + distance * np.array([along, across])
            return place, pin_speed + distance * rod_turn * np.array([-across, along])

        ground = system.AddObject(items.ObjectGround())
        # Its motion is given: the crank needs no inertia of its own, which would enter the torque.
        node, crank = self.body(system, 1.0, 1e-9, [0, 0, start], [0, 0, turn])
        centre, centre_speed = on_rod(gravity)
        _, rod_body = self.body(
            system, rod["mass"], rod["inertia"], [*centre, -lean], [*centre_speed, rod_turn]
        )
        piston_place, piston_speed = on_rod(length)
        _, piston = self.body(
            system, self.train["piston_mass"], 1e-3, [*piston_place, 0], [*piston_speed, 0]
        )

        def joint(one, place, other, other_place, axes):
            markers = [
                system.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*at, 0]))
                for body, at in [(one, place), (other, other_place)]
            ]
            return system.AddObject(items.GenericJoint(markerNumbers=markers, constrainedAxes=axes))

        hinge = [1, 1, 0, 0, 0, 0]
        joint(ground, [0, 0], crank, [0, 0], hinge)
        big_end = joint(crank, [radius, 0], rod_body, [-gravity, 0], hinge)
        small_end = joint(piston, [0, 0], rod_body, [length - gravity, 0], hinge)
        guide = joint(ground, [0, self.offset], piston, [0, 0], [0, 1, 0, 0, 0, 1])

        def crank_angle(time):
            return self.speed * time - self.LEAD_IN

        fixed = system.AddNode(items.NodePointGround())
        drive = system.AddObject(
            items.CoordinateConstraint(
                markerNumbers=[
                    system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=fixed, coordinate=0)),
                    system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2)),
                ],
                offsetUserFunction=lambda _, t, *__: self.arm(crank_angle(t))[0] - start,
                offsetUserFunction_t=lambda _, t, *__: self.speed * self.arm(crank_angle(t))[1],
            )
        )
        system.AddLoad(
            items.LoadForceVector(
                markerNumber=system.AddMarker(items.MarkerBodyPosition(bodyNumber=piston)),
                loadVector=[0, 0, 0],
                loadVectorUserFunction=lambda _, t, __: [
                    -self.gas_force(self.arm(crank_angle(t))[0]),
                    0,
                    0,
                ],
            )
        )

        def watch(number, kind):
            return system.AddSensor(
                items.SensorObject(
                    objectNumber=number,
                    outputVariableType=kind,
                    storeInternal=True,
                    writeToFile=False,
                )
            )

        kinds = exudyn.OutputVariableType
        joints = [watch(one, kinds.ForceLocal) for one in (big_end, small_end, guide)]
        torque = watch(drive, kinds.Force)
        system.Assemble()
        whole = 4 * np.pi + self.LEAD_IN
        steps = round(whole / self.STEP)
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.numberOfSteps = steps
        settings.timeIntegration.endTime = whole / self.speed
        settings.timeIntegration.verboseMode = 0
        settings.timeIntegration.generalizedAlpha.spectralRadius = 0.7
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = whole / self.speed / steps
        assert system.SolveDynamic(settings)

        # A joint's force acts on its first body, in the axes of that body.
        pin, small, side = (np.array(system.GetSensorStoredData(one)) for one in joints)
        angles = crank_angle(pin[:, 0])
        arm, _ = self.arm(angles)
        return angles, {
            "big_end": np.stack(
                [
                    np.cos(arm) * pin[:, 1] - np.sin(arm) * pin[:, 2],
                    np.sin(arm) * pin[:, 1] + np.cos(arm) * pin[:, 2],
                ],
                axis=1,
            ),
            "small_end": small[:, 1:3],
            "side_thrust": -side[:, 2],
            "torque": np.array(system.GetSensorStoredData(torque))[:, 1],
        }


@pytest.mark.parametrize("case", [0, 1], ids=["even speed", "speed ripple"])
def test_slider_crank_forces_are_those_of_exudyn(oracles, case):
    data = oracles["slider_crank"]
    found = data["cases"][case]
    assert bool(found["motion"]["twists"]) == bool(case)
    angles, expected = SliderCrank(data, found["motion"]).run()
    at = np.array([row["crank_angle"] for row in found["rows"]])
    for name, values in expected.items():
        ours = np.array([row[name] for row in found["rows"]]).reshape(len(at), -1)
        theirs = values.reshape(len(angles), -1)
        for column in range(ours.shape[1]):
            there = np.interp(at, angles, theirs[:, column])
            # Each component over its own peak.
            apart = np.max(np.abs(ours[:, column] - there)) / np.max(np.abs(there))
            assert apart < FORCES, f"{name} {column}: {apart}"
