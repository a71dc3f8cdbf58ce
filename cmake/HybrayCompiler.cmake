# What every target of the project is compiled with. Portable by default: a baseline of x86-64-v2, and no fused
# multiply-add anywhere, so that the same source gives the same bits on every machine (docs/algorithms.md).
add_library(hybray_compiler INTERFACE)
target_compile_features(hybray_compiler INTERFACE cxx_std_20)
target_compile_options(hybray_compiler INTERFACE
  -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False positives of GCC 12 on std::string concatenation (GCC bug 105329).
  target_compile_options(hybray_compiler INTERFACE -Wno-restrict)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(hybray_compiler INTERFACE -march=x86-64-v2)
endif()
if(HYBRAY_WERROR)
  target_compile_options(hybray_compiler INTERFACE -Werror)
endif()
target_include_directories(hybray_compiler INTERFACE ${PROJECT_SOURCE_DIR})
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(HYBRAY_CCACHE ccache)
if(HYBRAY_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${HYBRAY_CCACHE})
endif()
