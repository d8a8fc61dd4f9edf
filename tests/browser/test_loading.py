"""The page comes from one file, without a network and without errors."""

from conftest import INSIDE


def test_the_page_loads_from_its_file_alone_even_offline(fresh, found):
    live = fresh(offline=True)
    live.wait("page.view.differential.gears")
    own = [address for address in live.asked if address.startswith(live.address)]
    inside = [address for address in live.asked if address.startswith(INSIDE)]
    # this test sees requests: that for the page is one
    assert len(own) == 1
    assert len(own) + len(inside) == len(live.asked)
    assert live.page.title()
    found(f"{len(own)} file, {len(inside)} of blob: and data:, nothing else")
