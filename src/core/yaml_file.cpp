#include "yaml_file.h"

#include <algorithm>
#include <cmath>
#include <ios>
#include <set>
#include <stdexcept>
#include <utility>

namespace omr
{
YamlFile::YamlFile(std::string file, std::string key, const YAML::Node& node, int line)
    : file_(std::move(file)), key_(std::move(key)), node_(node), line_(line)
{
}

template <typename Read>
YamlFile YamlFile::read(const std::string& file, const Read& read)
{
  try
  {
    std::vector<YAML::Node> documents = read();
    while (documents.size() > 1 && documents.back().IsNull())  // a last --- ends a file, as in what rostopic echoes
    {
      documents.pop_back();
    }
    if (documents.size() > 1)
    {
      const YamlFile second(file, "", documents[1], documents[1].Mark().line + 1);
      second.fail("a second document, behind '---', would be ignored: expected a file of one; remove the '---'");
    }
    return {file, "", documents.empty() ? YAML::Node() : documents.front(), 1};
  }
  catch (const YAML::BadFile&)
  {
    throw std::runtime_error("cannot read the file '" + file + "'");
  }
  catch (const std::ios_base::failure&)  // of a directory, which opens but does not read
  {
    throw std::runtime_error("cannot read the file '" + file + "': is it a directory?");
  }
  catch (const YAML::Exception& error)
  {
    throw std::invalid_argument(file + ":" + std::to_string(error.mark.line + 1) + ": not valid yaml: " + error.msg);
  }
}

YamlFile YamlFile::load(const std::string& file)
{
  return read(file, [&] { return YAML::LoadAllFromFile(file); });
}

YamlFile YamlFile::parse(const std::string& text, const std::string& name)
{
  return read(name, [&] { return YAML::LoadAll(text); });
}

void YamlFile::fail(const std::string& message) const
{
  throw std::invalid_argument(file_ + ":" + std::to_string(line_) + ": " + (key_.empty() ? "" : key_ + ": ") + message);
}

const std::string& YamlFile::key() const
{
  return key_;
}

bool YamlFile::has(const std::string& key) const
{
  return node_.IsMap() && node_[key].IsDefined();
}

YamlFile YamlFile::get(const std::string& key, const std::string& expected) const
{
  if (!node_.IsMap())
  {
    fail("expected a map with the key '" + key + "'");
  }
  const YAML::Node value = node_[key];
  if (!value.IsDefined())
  {
    fail("the key '" + key + "' is missing: expected " + expected);
  }
  if (value.IsNull())
  {
    forEach(expected, [&](const std::string& name, const YamlFile& entry) {
      if (name == key)
      {
        entry.fail("the key '" + key + "' has no value: expected " + expected);
      }
    });
  }
  return {file_, (key_.empty() ? "" : key_ + ".") + key, value, value.Mark().line + 1};
}

void YamlFile::forEach(const std::string& expected,
                       const std::function<void(const std::string& key, const YamlFile& value)>& call) const
{
  if (!node_.IsMap() && !node_.IsNull())
  {
    fail("expected " + expected);
  }
  std::set<std::string> found;
  for (const auto& entry : node_)
  {
    const int line = entry.first.Mark().line + 1;
    const YamlFile name(file_, key_, entry.first, line);
    const std::string key = name.text("a key");
    if (!found.insert(key).second)
    {
      name.fail("the key '" + key + "' stands here twice");
    }
    call(key, YamlFile(file_, key_, entry.second, line));
  }
}

void YamlFile::allowOnly(const std::vector<std::string>& keys, const std::string& expected) const
{
  if (!node_.IsMap())
  {
    fail("expected " + expected);
  }
  forEach(expected, [&](const std::string& key, const YamlFile& at) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
    {
      std::string message = "there is no key '";
      message += key;
      message += keys.size() == 1 ? "': expected " : "': expected one of ";
      for (const std::string& known : keys)
      {
        message += known == keys.front() ? "" : ", ";
        message += known;
      }
      at.fail(message);
    }
  });
}

std::vector<YamlFile> YamlFile::list(const std::string& expected, std::size_t size) const
{
  if (!node_.IsSequence() || (size != 0 && node_.size() != size))
  {
    const bool wrong_size = node_.IsSequence();
    fail("expected " + expected + (wrong_size ? ", not " + std::to_string(node_.size()) + " values" : ""));
  }
  std::vector<YamlFile> entries;
  for (std::size_t i = 0; i < node_.size(); ++i)
  {
    const YAML::Node entry = node_[i];
    entries.push_back(YamlFile(file_, key_ + "[" + std::to_string(i) + "]", entry, entry.Mark().line + 1));
  }
  return entries;
}

std::string YamlFile::text(const std::string& expected) const
{
  if (!node_.IsScalar() || node_.Scalar().empty())
  {
    fail("expected " + expected);
  }
  return node_.Scalar();
}

double YamlFile::number(const std::string& expected, double min, double max) const
{
  double value = 0;
  const std::string written = text(expected);
  if (!YAML::convert<double>::decode(node_, value) || !std::isfinite(value) || value < min || value > max)
  {
    fail("expected " + expected + ", not '" + written + "'");
  }
  return value;
}

int YamlFile::integer(const std::string& expected, int min, int max) const
{
  const double value = number(expected, min, max);
  if (value != std::floor(value))
  {
    fail("expected " + expected + ", not '" + text(expected) + "'");
  }
  return static_cast<int>(value);
}

std::vector<double> YamlFile::numbers(const std::string& expected, std::size_t size) const
{
  std::vector<double> values;
  for (const YamlFile& entry : list(expected, size))
  {
    values.push_back(entry.number("a number"));
  }
  return values;
}

}  // namespace omr
