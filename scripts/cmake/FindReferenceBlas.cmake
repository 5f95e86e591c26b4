# Blas::reference: Debian's reference BLAS and LAPACK, which a program loads before its other
# libraries do; the BLAS that is loaded first serves all of them. SuiteSparse, which Ceres needs, is
# linked with the BLAS that the machine's alternatives select. Some of these start threads before
# main(), which spin for ever where memory is limited. --disable-new-dtags writes DT_RPATH, which the
# loader searches before LD_LIBRARY_PATH.
if(TARGET Blas::reference)
  return()
endif()
find_library(REFERENCE_BLAS_LIBRARY libblas.so.3 PATH_SUFFIXES blas REQUIRED)
find_library(REFERENCE_LAPACK_LIBRARY liblapack.so.3 PATH_SUFFIXES lapack REQUIRED)
add_library(Blas::reference INTERFACE IMPORTED)
target_link_libraries(Blas::reference INTERFACE -Wl,--push-state,--no-as-needed
  ${REFERENCE_BLAS_LIBRARY} ${REFERENCE_LAPACK_LIBRARY} -Wl,--pop-state)
target_link_options(Blas::reference INTERFACE -Wl,--disable-new-dtags)

# Ceres links the alternatives too: of LAPACK it gets the static library that CSDP::sdp has.
foreach(target IN ITEMS Ceres::ceres BLAS::BLAS LAPACK::LAPACK)
  if(TARGET ${target})
    get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
    list(FILTER libraries EXCLUDE REGEX "/lib(lapack|blas|f77blas|atlas)\\.")
    set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${libraries}")
  endif()
endforeach()
set_property(TARGET Ceres::ceres APPEND PROPERTY INTERFACE_LINK_LIBRARIES
  ${CSDP_LAPACK_LIBRARY} ${CSDP_BLAS_LIBRARY} ${CSDP_FORTRAN_LIBRARY})
