# cmake -DFILE=... -DGZIPPED=BYTES -DSCRATCH=... -P check_gzipped.cmake: fails where the file, gzipped, is larger.
set(archive ${SCRATCH}/gzipped.gz)
file(ARCHIVE_CREATE OUTPUT ${archive} PATHS ${FILE} FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
file(SIZE ${archive} bytes)
file(SIZE ${FILE} plain)
message("${FILE}: ${plain} bytes, ${bytes} gzipped; the budget is ${GZIPPED}")
if(bytes GREATER GZIPPED)
  message(FATAL_ERROR "above the budget")
endif()
