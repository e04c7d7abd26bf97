# Debian's cross compiler for AArch64; programs run under qemu-user. Of core and its tests (preset
# "aarch64"): .ci/tools/aarch64 installs what it needs.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# With Debian's libc6:arm64, which the libraries of core bring along: with the cross compiler's own
# copy of it (-L /usr/aarch64-linux-gnu) the child of a fork() never comes back, so that no death test
# ends.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
# Headers without code (Eigen) and CMake's own modules are this machine's.
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu /usr)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
