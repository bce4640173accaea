# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the parts built by CMake need of the loaded OpenFOAM: the target OpenFOAM (its
# base headers and library, with wmake's definitions) and our own warnings.

include_guard()

foreach(name WM_PROJECT_DIR FOAM_LIBBIN FOAM_USER_LIBBIN FOAM_USER_APPBIN)
    if("$ENV{${name}}" STREQUAL "")
        message(FATAL_ERROR "${name} is not set: source OpenFOAM's etc/bashrc first.")
    endif()
endforeach()

# Where libraries and programs go; Allwmake sets them.
foreach(name LIBBIN APPBIN)
    set(FOAM_MODULE_${name} "$ENV{FOAM_MODULE_${name}}")
    if(NOT FOAM_MODULE_${name})
        set(FOAM_MODULE_${name} "$ENV{FOAM_USER_${name}}")
    endif()
endforeach()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()
# As wmake: assertions stay out of releases by OpenFOAM's own means, not by NDEBUG.
set(CMAKE_CXX_FLAGS_RELEASE "-O3")

# Sources are compiled jointly, as those of the libraries (Make/joinSources).
set(CMAKE_UNITY_BUILD ON)

find_package(OpenMP REQUIRED)
get_filename_component(stabilityRoot "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

if("$ENV{WM_OSTYPE}" STREQUAL "")
    set(foamSystem POSIX)
else()
    set(foamSystem $ENV{WM_OSTYPE})
endif()
string(REGEX MATCH "[0-9]+" foamApi "$ENV{FOAM_API}")

add_library(OpenFOAM INTERFACE)
target_compile_definitions(OpenFOAM INTERFACE
    OPENFOAM=${foamApi} WM_DP WM_LABEL_SIZE=$ENV{WM_LABEL_SIZE} NoRepository)
target_include_directories(OpenFOAM INTERFACE ${stabilityRoot}/src)
target_include_directories(OpenFOAM SYSTEM INTERFACE
    $ENV{WM_PROJECT_DIR}/src/OpenFOAM/lnInclude
    $ENV{WM_PROJECT_DIR}/src/OSspecific/${foamSystem}/lnInclude)
target_compile_options(OpenFOAM INTERFACE
    -Wall -Wextra -Wno-unused-parameter -ffp-contract=off
    # What the optimizer suspects where OpenFOAM's lists are inlined into our code.
    -Wno-alloc-size-larger-than -Wno-array-bounds -Wno-stringop-overflow)
# Alltest has STABILITY_ERRORS=-Werror in the environment.
if(NOT "$ENV{STABILITY_ERRORS}" STREQUAL "")
    target_compile_options(OpenFOAM INTERFACE
        $ENV{STABILITY_ERRORS} -Wno-error=uninitialized -Wno-error=maybe-uninitialized)
endif()
target_link_directories(OpenFOAM INTERFACE
    $ENV{FOAM_LIBBIN} $ENV{FOAM_LIBBIN}/$ENV{FOAM_MPI})
target_link_libraries(OpenFOAM INTERFACE libOpenFOAM.so dl OpenMP::OpenMP_CXX)

# The core as wmake built it.
add_library(core INTERFACE)
target_link_directories(core INTERFACE ${FOAM_MODULE_LIBBIN})
target_link_libraries(core INTERFACE libinterfaceStabilityCore.so OpenFOAM)
