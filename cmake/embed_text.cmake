# Writes a text file into a C++ constant, so that nothing is looked up at run time:
#   cmake -D OUTPUT=FILE.cpp -D HEADER=FILE.h -D NAME=CONSTANT -D SOURCE=TEXT -P embed_text.cmake
file(READ "${SOURCE}" content)
file(WRITE "${OUTPUT}"
  "#include \"${HEADER}\"\n\nnamespace omr\n{\nconst char* const ${NAME} = R\"TEXT(${content})TEXT\";\n}  // namespace omr\n")
