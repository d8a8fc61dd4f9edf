"""Numbers and names in pictures."""

import pytest
from bevel_differential.readable import in_words


@pytest.mark.parametrize("name, words", [
    ("planet[1].left_transmission_error_peak_to_peak:final", "transmission error, peak to peak, planet 1 left"),
    ("safety.root_min", "least root safety"),
    ("left.speed:mean", "left speed, mean"),
    ("stress.contact_max:final", "largest contact stress"),
    ("efficiency", "efficiency"),
])
def test_labels_of_axes_are_words(name, words):
    assert in_words(name) == words
