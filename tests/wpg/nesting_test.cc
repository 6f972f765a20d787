#include "wpg/files/nesting.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/wpg/repeated.h"

namespace halfstep {
namespace {

constexpr int kEndless = std::numeric_limits<int>::max();

TEST(JsonDepth, CountsArraysAndObjectsOutsideOfTexts) {
  EXPECT_EQ(JsonDepth("3"), 0);
  EXPECT_EQ(JsonDepth("[]"), 1);
  EXPECT_EQ(JsonDepth(R"({"a": [1, {"b": []}], "c": [2]})"), 4);
  EXPECT_EQ(JsonDepth(R"(["[[[", "\"[[", "\\", []])"), 2);
  EXPECT_EQ(JsonDepth(Repeated("[", 100'000)), 100'000);
}

TEST(XmlDepth, CountsElements) {
  EXPECT_EQ(XmlDepth(""), 0);
  EXPECT_EQ(XmlDepth("<?xml version=\"1.0\" encoding='UTF-8'?><!DOCTYPE x><a/>"), 1);
  EXPECT_EQ(XmlDepth("<a><b/><b><c x='1'/></b><b></b></a>"), 3);
  EXPECT_EQ(XmlDepth(Repeated("<a>", 40'000)), 40'000);
}

TEST(XmlDepth, WhatHoldsNoElementsHidesNone) {
  EXPECT_EQ(XmlDepth("<a><!-- </a><b><c> --><![CDATA[<d><e>]]></a>"), 1);
  EXPECT_EQ(XmlDepth("<a x='<b>' y=\"/>\"><b/></a>"), 2);
  EXPECT_EQ(XmlDepth("</z></z><a><b/></a>"), 2);
  EXPECT_EQ(XmlDepth("<a><1 \"><b><c/></b></a>"), 3);  // TinyXML: unknown, up to the next '>'
}

// What TinyXML takes for the end of a declaration depends on its quotes.
TEST(XmlDepth, AnOddDeclarationCountsAsEndless) {
  EXPECT_EQ(XmlDepth("<?xml version=\"><!--\"?><a><a/></a>"), kEndless);
  EXPECT_EQ(XmlDepth("<?XML x' version='>'?><a/>"), kEndless);
  EXPECT_EQ(XmlDepth("<?xml version='1.0'" + std::string(300, ' ') + "?><a/>"), kEndless);
}

}  // namespace
}  // namespace halfstep
