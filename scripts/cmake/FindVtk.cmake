# VTK with OpenGL alone: no text, no readers. SCENE_CONTEXTS: how a context of OpenGL without a
# screen is made, the way to take first: osmesa, egl.
enable_language(C)  # VTK's package looks for C libraries.
find_package(VTK 9.1 REQUIRED
  COMPONENTS CommonCore CommonDataModel FiltersCore RenderingCore RenderingOpenGL2
  OPTIONAL_COMPONENTS glew)  # Before 9.4.
find_package(OpenGL REQUIRED COMPONENTS EGL)
set(SCENE_CONTEXTS egl)
# Mesa has had no OSMesa since 25.1.
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h)
find_library(OSMESA_LIBRARY OSMesa)
if(MAPPROOF_OSMESA AND OSMESA_INCLUDE_DIR AND OSMESA_LIBRARY AND VTK_VERSION VERSION_LESS 9.4)
  list(PREPEND SCENE_CONTEXTS osmesa)
endif()
