// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The few places where Slicer 5.0 and later ones want different code, each behind one name.

#include <string>

#if __has_include(<vtkMRMLI18N.h>)
#include <vtkMRMLI18N.h>
#else
/// `text` in the user's language, in code without Qt. Slicer has it since 5.6, and its tools collect texts by this
/// name; before, text stays as it is.
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

/// To be called before a colour table's names are set. Slicer 5.0 makes up names from the colours unless told that
/// there are names. Later ones know for every entry whether it is defined, and take being told for an error.
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

/// Whether an entry of a colour table means something. Slicer 5.0 says so by its name.
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

/// Table views show the columns' names rather than A, B, C. Later Slicers call them titles, and warn of the older name.
template <class TableNode>
void showColumnNames(TableNode* table)
{
  showColumnNames(table, 0);
}

} // namespace host
} // namespace surgicalmesher
