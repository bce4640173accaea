# SPDX-License-Identifier: GPL-3.0-or-later
#
# The rest of the libraries, and the programs, with sanitizers: named as wmake and the
# other CMake files name them, so that a path is all that it takes to use them.

set(foamParts finiteVolume meshTools fileFormats surfMesh)
list(TRANSFORM foamParts REPLACE "(.+)" "$ENV{WM_PROJECT_DIR}/src/\\1/lnInclude"
    OUTPUT_VARIABLE foamHeaders)

file(GLOB foamSources CONFIGURE_DEPENDS ${src}/foam/*.C ${src}/foam/Make/joined/*.C)
add_library(sanitizedFoam SHARED EXCLUDE_FROM_ALL ${foamSources})
set_target_properties(sanitizedFoam PROPERTIES
    UNITY_BUILD OFF OUTPUT_NAME interfaceStability)
target_include_directories(sanitizedFoam SYSTEM PUBLIC ${foamHeaders})
target_link_libraries(sanitizedFoam PUBLIC
    testedCore finiteVolume meshTools genericPatchFields twoPhaseProperties)

set(utilities ${src}/../applications/utilities)
add_executable(sanitizedUtility EXCLUDE_FROM_ALL
    ${utilities}/postProcessing/interfaceStability/interfaceStability.C)
set_target_properties(sanitizedUtility PROPERTIES OUTPUT_NAME interfaceStability)
target_link_libraries(sanitizedUtility PRIVATE sanitizedFoam)

add_subdirectory(${src}/vtk vtk EXCLUDE_FROM_ALL)
add_dependencies(interfaceStabilityVtk testedCore)
add_subdirectory(${utilities}/visualization/interfaceStabilityView viewer EXCLUDE_FROM_ALL)

add_custom_target(programs DEPENDS
    sanitizedUtility interfaceStabilityVtk interfaceStabilityView)
