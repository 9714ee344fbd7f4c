@echo on
cargo install --locked --no-track --path . --features hdf5 --root "%LIBRARY_PREFIX%"
if errorlevel 1 exit 1
