"""What manufacturing tolerances do: spread of figures, yield, the parts of each tolerance, and which is worth its money."""

from .factor import Factor, Reader
from .figures import Spread
from .plan import Plan
from .study import Alternative, Study
from .verdict import verdicts

__all__ = ["Alternative", "Factor", "Plan", "Reader", "Spread", "Study", "verdicts"]
