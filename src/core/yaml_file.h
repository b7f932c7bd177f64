#ifndef OUTDOOR_OMR_CORE_YAML_FILE_H
#define OUTDOOR_OMR_CORE_YAML_FILE_H

#include <yaml-cpp/yaml.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace omr
{
/** A node of a yaml file that knows its file, line and key, so that what is wrong with it can be found. Whatever does
 * not suit throws std::invalid_argument. */
class YamlFile
{
 public:
  /** The root of a file, which is of one document. @throws std::runtime_error if the file cannot be read. */
  static YamlFile load(const std::string& file);

  /** The root of a text. @param name that errors give the file. */
  static YamlFile parse(const std::string& text, const std::string& name);

  /** Throws with file, line and key: "FILE:LINE: KEY: MESSAGE". */
  [[noreturn]] void fail(const std::string& message) const;

  /** From the root, as in parts[0].name. */
  const std::string& key() const;

  bool has(const std::string& key) const;

  /** The value of a map. `expected` says what is to be there if it is not. */
  YamlFile get(const std::string& key, const std::string& expected) const;

  /** Calls with each key and value of a map; what fails there names the map's key and the entry's line. Nothing is a
   * map of no keys. Refuses keys that stand there twice. */
  void forEach(const std::string& expected,
               const std::function<void(const std::string& key, const YamlFile& value)>& call) const;

  /** Refuses all keys but these, and keys that stand there twice. */
  void allowOnly(const std::vector<std::string>& keys, const std::string& expected) const;

  /** The entries of a list, of `size` ones if that is not 0. */
  std::vector<YamlFile> list(const std::string& expected, std::size_t size = 0) const;

  std::string text(const std::string& expected) const;
  double number(const std::string& expected, double min = std::numeric_limits<double>::lowest(),
                double max = std::numeric_limits<double>::max()) const;
  int integer(const std::string& expected, int min, int max) const;
  std::vector<double> numbers(const std::string& expected, std::size_t size = 0) const;

 private:
  template <typename Read>
  static YamlFile read(const std::string& file, const Read& read);
  YamlFile(std::string file, std::string key, const YAML::Node& node, int line);

  std::string file_;
  std::string key_;
  YAML::Node node_;
  int line_;
};

}  // namespace omr

#endif
