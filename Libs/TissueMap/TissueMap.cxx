#include "TissueMap.h"

namespace surgicalmesher
{

std::vector<Label> presentLabels(const TissueMap& map)
{
  std::vector<char> present(65536, 0);
  for (const Label label : map.labels) present[label] = 1;
  std::vector<Label> labels;
  for (int label = 1; label < 65536; ++label)
  {
    if (present[label]) labels.push_back(Label(label));
  }
  return labels;
}

} // namespace surgicalmesher
