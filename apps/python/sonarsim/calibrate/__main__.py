from ..need import need
need("numpy", "scipy", "yaml", "PIL")
from .command import main  # noqa: E402  pylint: disable=wrong-import-position
raise SystemExit(main())
