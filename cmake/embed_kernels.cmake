# Writes the OpenCL sources into one C++ file, so that nothing is looked up at run time:
#   cmake -D OUTPUT=FILE.cpp -D SOURCES=A.cl,B.cl -P embed_kernels.cmake
# Sources come in the order of their dependence and are compiled as one text: an #include becomes an empty line, and
# #line makes the messages of the device's compiler name the file and line of the kernel.
string(REPLACE "," ";" sources "${SOURCES}")
set(text "#include \"kernel_sources.h\"\n\nnamespace omr\n{\nconst char* const KERNEL_SOURCES[] = {\n")
foreach(source IN LISTS sources)
  get_filename_component(name "${source}" NAME)
  file(READ "${source}" content)
  string(REGEX REPLACE "#include \"[^\"]*\"" "" content "${content}")
  string(APPEND text "R\"CL(#line 1 \"kernels/${name}\"\n${content})CL\",\n")
endforeach()
string(APPEND text
  "};\nconst unsigned KERNEL_SOURCE_COUNT = sizeof(KERNEL_SOURCES) / sizeof(KERNEL_SOURCES[0]);\n"
  "}  // namespace omr\n")
file(WRITE "${OUTPUT}" "${text}")
