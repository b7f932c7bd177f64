#ifndef OUTDOOR_OMR_TOOLS_PROGRAM_H
#define OUTDOOR_OMR_TOOLS_PROGRAM_H

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace omr
{
/** How the programs end. */
enum ExitCode
{
  SUCCESS = 0,
  IMAGE_FAILED = 1,  ///< at least one image could not be read or used; the others were
  FAILED = 2         ///< wrong arguments, no device, no output
};

/** The main() of a program: declares the options, reads the arguments, runs. Nothing is thrown: what goes wrong is told
 * on standard error, after the program's name. @param declare void(CLI::App&, Options&). @param run ExitCode(const
 * Options&). */
template <typename Options, typename Declare, typename Run>
int runProgram(const std::string& name, int argc, char** argv, const Declare& declare, const Run& run)
{
  try
  {
    CLI::App app;
    Options options;
    declare(app, options);
    try
    {
      app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
      return app.exit(error) == 0 ? SUCCESS : FAILED;
    }
    const ExitCode code = run(options);
    if (!std::cout.flush())
    {
      throw std::runtime_error("cannot write to standard output; is the disk full?");
    }
    return code;
  }
  catch (const std::exception& error)
  {
    std::cerr << name << ": " << error.what() << "\n";
    return FAILED;
  }
}

}  // namespace omr

#endif
