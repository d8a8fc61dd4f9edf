"""Dynamics of a bevel gear differential, from Python.

>>> import numpy as np
>>> from bevel_differential import Differential
>>> turn = Differential({"scene.planet_spin": "imposed", "spin.command": "16 rpm",
...                      "carrier.speed_command": (100, "rpm")})
>>> speeds = turn.run(outputs=["left.speed", "right.speed"], stop=0.5)
>>> speeds.dtype.names
('time', 'left.speed', 'right.speed')
>>> print(f"{speeds['left.speed'][-375:].mean() * 30 / np.pi:.2f} rpm")  # mean over one tooth
110.00 rpm
"""

from .accuracy import Accuracy, accuracy
from .clutch import Clutch
from .comparison import Comparison, compare
from .differential import Differential
from .fmu import Fmu
from .losses import LossMap
from .scene import Scene
from .scene_file import shipped_scenes
from .values import DifferentialError, DifferentialWarning

__all__ = ["Accuracy", "Clutch", "Comparison", "Differential", "DifferentialError", "DifferentialWarning", "Fmu", "LossMap", "Scene",
           "accuracy", "compare", "shipped_scenes"]
