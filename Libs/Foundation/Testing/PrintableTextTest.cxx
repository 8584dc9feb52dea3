// SPDX-License-Identifier: Apache-2.0
// What goes into messages does no harm to what reads them.
#include "PrintableText.h"

#include "Errors.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;

// B8: bytes of a bad file stood raw in messages, which ended at the first NUL.
TEST(Trial, B08_controlCharactersAndBytesThatAreNoTextAreEscaped)
{
  EXPECT_EQ(printable("plain \"text\", é 脳 🧠\n\tnext"), "plain \"text\", é 脳 🧠\n\tnext");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\x1b[31mred\x7f\x08"), "\\x1b[31mred\\x7f\\x08");
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("cut \xe8\x84"), "cut \\xe8\\x84");
  EXPECT_EQ(printable("overlong \xc0\xaf, surrogate \xed\xa0\x80"), "overlong \\xc0\\xaf, surrogate \\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m \xe2\x80\xae"),
            "\\xc2\\x9b31m \\xe2\\x80\\xae");
}

TEST(PrintableText, textIsUTF8ToItsEnd)
{
  EXPECT_TRUE(isUTF8(""));
  EXPECT_TRUE(isUTF8(std::string("a\0é 🧠", 9)));
  EXPECT_FALSE(isUTF8("a\xff"));
  EXPECT_FALSE(isUTF8("cut \xe8\x84"));
}

TEST(PrintableText, quotedTextHasNoControlCharacters)
{
  EXPECT_EQ(quoted("a \"b\" \\ é"), R"("a \"b\" \\ é")");
  EXPECT_EQ(quoted("a\nb\x1b\x7f"), "\"a\\u000ab\\u001b\\u007f\"");
}

TEST(Trial, B08_errorsCarryTheWholeMessageInPrintableForm)
{
  const InputError error("a.lut:1: \"" + std::string("\xff\0\x1b", 3) + "\", expected a label");
  EXPECT_STREQ(error.what(), "a.lut:1: \"\\xff\\x00\\x1b\", expected a label");
}
