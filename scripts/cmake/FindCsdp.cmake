# CSDP::sdp: CSDP with the reference BLAS and LAPACK, as archives, so that no alternative BLAS of a
# machine, whose kernels change with its processor, takes their place.
find_path(CSDP_INCLUDE_DIR csdp/declarations.h REQUIRED)
find_library(CSDP_LIBRARY libsdp.a REQUIRED)
find_library(CSDP_LAPACK_LIBRARY liblapack.a PATH_SUFFIXES lapack REQUIRED)
find_library(CSDP_BLAS_LIBRARY libblas.a PATH_SUFFIXES blas REQUIRED)
find_library(CSDP_FORTRAN_LIBRARY libgfortran.so.5 REQUIRED)
# CSDP says so on standard output and ends the program where it finds no memory. In a copy of it,
# functions of core/embed/sde/csdp.cpp are called instead.
set(csdp_copy ${PROJECT_BINARY_DIR}/generated/libsdp.a)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/generated)
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND ${CMAKE_OBJCOPY}
  --redefine-sym exit=mapproof_csdp_exit --redefine-sym puts=mapproof_csdp_puts
  ${CSDP_LIBRARY} ${csdp_copy})
add_library(csdp_sdp INTERFACE)
add_library(CSDP::sdp ALIAS csdp_sdp)
target_include_directories(csdp_sdp SYSTEM INTERFACE ${CSDP_INCLUDE_DIR})
target_link_libraries(csdp_sdp INTERFACE
  ${csdp_copy} ${CSDP_LAPACK_LIBRARY} ${CSDP_BLAS_LIBRARY} ${CSDP_FORTRAN_LIBRARY})
