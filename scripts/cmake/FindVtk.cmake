# VTK with OpenGL alone: no text, no readers. VTK_HAS_OSMESA: it has a window of its own on OSMesa;
# otherwise ours takes OSMESA_LIBRARY.
enable_language(C)  # VTK's package looks for C libraries.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel FiltersCore RenderingCore RenderingOpenGL2)
# A VTK that was built with OSMesa has this header.
find_file(VTK_OSMESA_WINDOW vtkOSOpenGLRenderWindow.h
  PATHS /usr/include/vtk-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION} ${VTK_PREFIX_PATH}/include
  PATH_SUFFIXES vtk-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION})
set(VTK_HAS_OSMESA OFF)
if(VTK_OSMESA_WINDOW OR VTK_VERSION VERSION_GREATER_EQUAL 9.4)
  set(VTK_HAS_OSMESA ON)
else()
  find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)
  find_library(OSMESA_LIBRARY OSMesa REQUIRED)
endif()
