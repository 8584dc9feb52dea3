// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Differences between Slicer 5.0 and later versions, each behind one name.

#include <string>

#if __has_include(<vtkMRMLI18N.h>)
#include <vtkMRMLI18N.h>
#else
/// Returns `text` in the user's language, in code without Qt. Slicer provides this function since 5.6, and its tools
/// collect texts by this name; in earlier versions, texts are not translated.
inline std::string vtkMRMLTr(const char*, const char* text) { return text; }
#endif

namespace surgicalmesher
{
namespace host
{

template <class ColorNode>
auto keepColorNames(ColorNode* colors, int) -> decltype(colors->SetColorDefined(0, true), void())
{
}

template <class ColorNode>
void keepColorNames(ColorNode* colors, long)
{
  colors->NamesInitialisedOn();
}

/// To be called before the names of a colour table are set. Slicer 5.0 generates names from the colours unless told
/// that names exist. Later versions know for every entry whether it is defined and report the old call as an error.
template <class ColorNode>
void keepColorNames(ColorNode* colors)
{
  keepColorNames(colors, 0);
}

template <class ColorNode>
auto hasColorName(ColorNode* colors, int index, int) -> decltype(colors->GetColorDefined(index))
{
  return colors->GetColorDefined(index);
}

template <class ColorNode>
bool hasColorName(ColorNode* colors, int index, long)
{
  const char* noName = colors->GetNoName();
  return std::string(noName ? noName : "") != colors->GetColorName(index);
}

/// Whether an entry of a colour table is defined. Slicer 5.0 marks undefined entries by their name.
template <class ColorNode>
bool hasColorName(ColorNode* colors, int index)
{
  const char* name = colors->GetColorName(index);
  return name && *name && hasColorName(colors, index, 0);
}

template <class TableNode>
auto showColumnNames(TableNode* table, int) -> decltype(table->SetUseColumnTitleAsColumnHeader(true), void())
{
  table->SetUseColumnTitleAsColumnHeader(true);
}

template <class TableNode>
void showColumnNames(TableNode* table, long)
{
  table->SetUseColumnNameAsColumnHeader(true);
}

/// Makes table views show column names instead of A, B, C. Later versions of Slicer call them titles and warn about the
/// old call.
template <class TableNode>
void showColumnNames(TableNode* table)
{
  showColumnNames(table, 0);
}

} // namespace host
} // namespace surgicalmesher
