# Blas::reference: Debian's reference BLAS and LAPACK, for a program to load before its libraries do.
# SuiteSparse, which Ceres brings in, is linked with whatever BLAS is the machine's alternative; some
# start threads before main(), which spin for ever where memory is limited. What is loaded first
# serves all. A search path of the old kind, before which LD_LIBRARY_PATH does not stand.
find_library(REFERENCE_BLAS_LIBRARY libblas.so.3 PATH_SUFFIXES blas REQUIRED)
find_library(REFERENCE_LAPACK_LIBRARY liblapack.so.3 PATH_SUFFIXES lapack REQUIRED)
add_library(reference_blas INTERFACE)
add_library(Blas::reference ALIAS reference_blas)
target_link_libraries(reference_blas INTERFACE -Wl,--push-state,--no-as-needed
  ${REFERENCE_BLAS_LIBRARY} ${REFERENCE_LAPACK_LIBRARY} -Wl,--pop-state)
target_link_options(reference_blas INTERFACE -Wl,--disable-new-dtags)

# Ceres names the alternatives too; what it calls itself is in the archives of CSDP::sdp.
foreach(target IN ITEMS Ceres::ceres BLAS::BLAS LAPACK::LAPACK)
  if(TARGET ${target})
    get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
    list(FILTER libraries EXCLUDE REGEX "/lib(lapack|blas|f77blas|atlas)\\.")
    set_target_properties(${target} PROPERTIES INTERFACE_LINK_LIBRARIES "${libraries}")
  endif()
endforeach()
