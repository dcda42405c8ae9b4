from ..command import need
need("calibrate", "numpy", "scipy", "yaml", "PIL")
from .command import main  # noqa: E402  pylint: disable=wrong-import-position
raise SystemExit(main())
