"""Which model is accurate enough: the cheapest that gives wanted quantities to an accuracy, proven in runs of the scene."""

from .question import Accuracy, Choice, Run, accuracy

__all__ = ["Accuracy", "Choice", "Run", "accuracy"]
