"""Callbacks for instances. fmpy's default callbacks share one logger among all instances of a process, even after the
instance that set it is freed. Tests that make instances directly therefore pass their own callbacks."""

from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE


def silent():
    """Callbacks with a logger that does nothing; keep them as long as the instance."""
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_: None)
    return callbacks
