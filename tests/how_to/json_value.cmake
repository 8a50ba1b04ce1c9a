# Prints the value of a dotted key of a JSON file, to stderr: cmake -D FILE=... -D KEY=... -P json_value.cmake
file(READ "${FILE}" json)
string(REPLACE "." ";" path "${KEY}")
string(JSON value ERROR_VARIABLE error GET "${json}" ${path})
if(error)
  message(FATAL_ERROR "${FILE} has no ${KEY}: ${error}")
endif()
message("${value}")
