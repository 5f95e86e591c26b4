# VTK with OpenGL only: no text, no readers. SCENE_CONTEXTS lists the ways to make an OpenGL context
# without a screen, the preferred one first: osmesa and egl, or egl.
enable_language(C)  # VTK's package looks for C libraries.
find_package(VTK 9.1 REQUIRED
  COMPONENTS CommonCore CommonDataModel FiltersCore RenderingCore RenderingOpenGL2
  OPTIONAL_COMPONENTS glew)  # VTK 9.4 and newer have none.
find_package(OpenGL REQUIRED COMPONENTS EGL)
set(SCENE_CONTEXTS egl)
# Mesa 25.1 and newer have no OSMesa (docs/decisions/0009).
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h)
find_library(OSMESA_LIBRARY OSMesa)
if(MAPPROOF_OSMESA AND OSMESA_INCLUDE_DIR AND OSMESA_LIBRARY AND VTK_VERSION VERSION_LESS 9.4)
  list(PREPEND SCENE_CONTEXTS osmesa)
endif()
