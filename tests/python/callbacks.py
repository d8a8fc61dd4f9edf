"""What an instance is given to call. fmpy's own callbacks share one place for the logger among all instances of a process,
also after the one that put its logger there is gone; tests that make instances by themselves bring callbacks of their own."""

from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE


def silent():
    """Callbacks whose logger says nothing; to be kept as long as the instance."""
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_: None)
    return callbacks
