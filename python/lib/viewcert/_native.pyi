# The native part. Its types stand in the modules that take it: users have what `viewcert` exports.

from typing import Any

def __getattr__(name: str) -> Any: ...
