@echo on
cargo install --locked --no-track --path . --root "%LIBRARY_PREFIX%"
if errorlevel 1 exit 1
