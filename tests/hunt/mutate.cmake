# cmake -DFROM=... -DTO=... -DFIND=... -DREPLACE=... -P mutate.cmake
# Writes a copy of a source with one inserted mistake. FIND must occur exactly once.
file(READ ${FROM} text)
string(FIND "${text}" "${FIND}" first)
string(FIND "${text}" "${FIND}" last REVERSE)
if(first EQUAL -1 OR NOT first EQUAL last)
  message(FATAL_ERROR "${FROM}: '${FIND}' must be there exactly once")
endif()
string(REPLACE "${FIND}" "${REPLACE}" text "${text}")
file(WRITE ${TO} "${text}")
