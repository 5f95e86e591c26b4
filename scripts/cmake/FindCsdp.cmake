# CSDP::sdp: CSDP with the reference BLAS and LAPACK, as static libraries, so that no alternative
# BLAS of the machine, whose results depend on the processor, replaces them.
if(TARGET CSDP::sdp)
  return()
endif()
find_path(CSDP_INCLUDE_DIR csdp/declarations.h REQUIRED)
find_library(CSDP_LIBRARY libsdp.a REQUIRED)
find_library(CSDP_LAPACK_LIBRARY liblapack.a PATH_SUFFIXES lapack REQUIRED)
find_library(CSDP_BLAS_LIBRARY libblas.a PATH_SUFFIXES blas REQUIRED)
find_library(CSDP_FORTRAN_LIBRARY libgfortran.so.5 REQUIRED)
# When memory runs out, CSDP prints a message on standard output and calls exit(). A copy of the
# library calls functions of core/embed/sde/csdp.cpp in place of puts() and exit(). It also reads a
# variable of that file in place of stdout, since it is not position-independent: a shared library
# can only be made of it where all variables are its own.
set(csdp_copy ${PROJECT_BINARY_DIR}/generated/libsdp.a)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/generated)
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND ${CMAKE_OBJCOPY}
  --redefine-sym exit=mapproof_csdp_exit --redefine-sym puts=mapproof_csdp_puts
  --redefine-sym stdout=mapproof_csdp_stdout
  ${CSDP_LIBRARY} ${csdp_copy})
add_library(CSDP::sdp INTERFACE IMPORTED)
target_include_directories(CSDP::sdp SYSTEM INTERFACE ${CSDP_INCLUDE_DIR})
target_link_libraries(CSDP::sdp INTERFACE
  ${csdp_copy} ${CSDP_LAPACK_LIBRARY} ${CSDP_BLAS_LIBRARY} ${CSDP_FORTRAN_LIBRARY})
