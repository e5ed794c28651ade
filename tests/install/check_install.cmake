# cmake -DWAY=find_package|pkg_config ... -P check_install.cmake: fails unless the consumer builds and runs.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nfailed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

if(WAY STREQUAL pkg_config AND NOT PKG_CONFIG)
  message("SKIPPED: there is no pkg-config on this machine")
  return()
endif()

set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
set(prefix ${SCRATCH}/prefix)
file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${prefix} --component library)

if(WAY STREQUAL find_package)
  run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${SCRATCH}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags}
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_C_FLAGS=${flags} -DEXAMPLES=${EXAMPLES}
    # Neither is part of the public interface: the package must do without them.
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DCMAKE_DISABLE_FIND_PACKAGE_nanoflann=ON)
  run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
  run(${SCRATCH}/build/decoder_consumer)
  run(${SCRATCH}/build/encoder_consumer)
  run(sh -c "${SCRATCH}/build/print_frames < ${STREAM}")
else()
  set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
  set(ENV{LD_LIBRARY_PATH} ${prefix}/${LIBDIR})
  foreach(half decoder encoder)
    run(${PKG_CONFIG} --static --cflags --libs tvg-${half})
    separate_arguments(options UNIX_COMMAND "${output}")
    run(${COMPILER} -std=c++20 ${flags} ${CONSUMER}/${half}_consumer.cpp ${options} -o ${SCRATCH}/${half}_consumer)
    run(${SCRATCH}/${half}_consumer)
  endforeach()
  run(${PKG_CONFIG} --cflags --libs tvg)
  separate_arguments(options UNIX_COMMAND "${output}")
  run(${C_COMPILER} -std=c99 ${flags} ${EXAMPLES}/print_frames.c ${options} -o ${SCRATCH}/print_frames)
  run(sh -c "${SCRATCH}/print_frames < ${STREAM}")
endif()
