"""`python -m bevel_differential`: the command."""

import sys

from .command import main

sys.exit(main())
