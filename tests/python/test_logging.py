"""What fmpy's users see of the FMU's log."""

import pytest


@pytest.fixture
def categories(through_fmpy):
    """categories(options): log categories of a short run by fmpy, in order."""

    def run(**options):
        log = []
        through_fmpy({}, 0.002, logger=lambda *line: log.append(line[3].decode()), **options)
        return log

    return run


def test_by_default_a_run_logs_nothing(categories):
    assert categories() == []


def test_debug_logging_reports_the_warning_of_the_start_values(categories):
    assert categories(debug_logging=True) == ["logEvents", "logStatusWarning", "logEvents", "logEvents"]


def test_errors_are_logged_without_debug_logging(through_fmpy):
    log = []
    with pytest.raises(Exception):
        through_fmpy({"geometry.module": 4.5}, logger=lambda *line: log.append((line[3].decode(), line[4].decode())))
    assert [category for category, _ in log] == ["logStatusError"]
    assert "geometry.module" in log[0][1]
