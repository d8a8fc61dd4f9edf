"""The picture of a sweep: all designs in every panel, and the Pareto front."""

import numpy as np
from command_line import command
from bevel_differential.designs.picture import front


def test_the_front_has_the_designs_that_no_other_one_dominates():
    costs = np.array([[1.0, 5.0], [2.0, 2.0], [2.0, 2.0], [3.0, 2.0], [5.0, 1.0], [np.nan, 0.0], [6.0, 6.0]])
    assert front(costs).tolist() == [True, True, True, False, True, False, False]
    assert front(-costs).tolist() == [False] * 6 + [True]
    assert front(costs[:, :1]).tolist() == [True] + [False] * 6


def test_a_picture_has_every_design_in_every_panel_and_the_front_of_the_objectives(tmp_path, figures):
    """On ideal gears without friction, both torques follow the carrier's torque, so the front is known."""
    line = ("sweep --scene torque_bias --set scene.gear_contact=ideal --set effects.tooth_friction=false --set effects.thrust_friction=false "
            "--stop 2ms --vary carrier.torque_command=100,200,300,400 --vary solver.method=adaptive,fixed_step --plan grid --want carrier.speed "
            f"--condition 'left.shaft_torque <= 180' --workers 0 --plot {tmp_path / 'a.png'}")
    command(f"{line} --objective 'maximise left.shaft_torque' --objective 'minimise carrier.torque'")
    command(line)
    both, matrix = figures
    # two varied values, three quantities, and a panel of the front
    assert len(both.axes) == 2 * 3 + 1 and len(matrix.axes) == 2 * 2
    for panel in [*both.axes, *matrix.axes]:
        assert sum(len(line.get_xdata()) for line in panel.lines) == 8
    lines = {line.get_label(): line for line in both.axes[-1].lines}
    # the condition leaves 100, 200 and 300 N·m, and more torque at the wheel needs more torque at the carrier
    assert len(lines["misses conditions"].get_xdata()) == 2 and "on the Pareto front" in lines
    assert [label.get_text() for label in matrix.axes[-1].get_xticklabels()] == ["adaptive", "fixed_step"]
