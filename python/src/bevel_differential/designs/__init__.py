"""Many designs of one scene: which values to try, and what each gives."""

from .farm import Farm
from .space import Dimension, Space
from .task import Row, Task

__all__ = ["Dimension", "Farm", "Row", "Space", "Task"]
