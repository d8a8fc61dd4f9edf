"""The page comes from one file, without a network and without errors."""

from conftest import INSIDE


def test_the_page_comes_from_its_file_alone_with_the_network_cut_off(live, found):
    live.wait("page.view.differential.gears")
    own = [address for address in live.asked if address.split("#")[0] == live.address]
    inside = [address for address in live.asked if address.startswith(INSIDE)]
    # the page's own request is among them, which proves that requests are recorded
    assert len(own) == 1
    assert len(own) + len(inside) == len(live.asked)
    assert live.faults == [] and live.message() == "" and live.page.title()
    found(f"1 file, {len(inside)} requests of blob: and data:, no other")
