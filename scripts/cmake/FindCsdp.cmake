# CSDP::sdp: CSDP with the reference BLAS and LAPACK, as archives, so that no alternative BLAS of a
# machine, whose kernels change with its processor, takes their place.
find_path(CSDP_INCLUDE_DIR csdp/declarations.h REQUIRED)
find_library(CSDP_LIBRARY libsdp.a REQUIRED)
find_library(CSDP_LAPACK_LIBRARY liblapack.a PATH_SUFFIXES lapack REQUIRED)
find_library(CSDP_BLAS_LIBRARY libblas.a PATH_SUFFIXES blas REQUIRED)
find_library(CSDP_FORTRAN_LIBRARY libgfortran.so.5 REQUIRED)
add_library(csdp_sdp INTERFACE)
add_library(CSDP::sdp ALIAS csdp_sdp)
target_include_directories(csdp_sdp SYSTEM INTERFACE ${CSDP_INCLUDE_DIR})
target_link_libraries(csdp_sdp INTERFACE
  ${CSDP_LIBRARY} ${CSDP_LAPACK_LIBRARY} ${CSDP_BLAS_LIBRARY} ${CSDP_FORTRAN_LIBRARY})
