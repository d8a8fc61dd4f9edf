"""Numbers and names in pictures."""

import pytest
from bevel_differential.readable import in_words, plain, time_scale, with_unit


@pytest.mark.parametrize("name, words", [
    ("planet[1].left_transmission_error_peak_to_peak:final", "transmission error, peak to peak, planet 1 left"),
    ("safety.root_min", "least root safety"),
    ("left.speed:mean", "left speed, mean"),
    ("stress.contact_max:final", "largest contact stress"),
    ("efficiency", "efficiency"),
])
def test_labels_of_axes_are_words(name, words):
    assert in_words(name) == words


@pytest.mark.parametrize("duration, unit", [(2.0, "s"), (0.1, "s"), (0.02, "ms"), (1e-4, "ms"), (5e-5, "µs")])
def test_short_times_are_shown_in_ms_or_us(duration, unit):
    factor, found = time_scale(duration)
    assert found == unit and factor == {"s": 1.0, "ms": 1e3, "µs": 1e6}[unit]


@pytest.mark.parametrize("value, text", [(1e-3, "0.001"), (0.1, "0.1"), (1.0, "1"), (1000.0, "1000"), (1.19e7, "11 900 000")])
def test_powers_of_ten_are_plain_numbers(value, text):
    assert plain(value) == text


def test_speeds_are_shown_in_rpm():
    assert with_unit(18.83213, "rad/s") == "179.8 rpm"
