"""Many designs of one scene: the values that vary, and the results."""

from .farm import Farm
from .space import Dimension, Space
from .task import Row, Task

__all__ = ["Dimension", "Farm", "Row", "Space", "Task"]
