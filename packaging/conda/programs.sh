#!/usr/bin/env bash
# The programs into $PREFIX. VIEWCERT_PROFILE=dev takes less time.
set -euo pipefail
cargo install --locked --no-track --path . --root "$PREFIX" --profile "${VIEWCERT_PROFILE:-release}"
