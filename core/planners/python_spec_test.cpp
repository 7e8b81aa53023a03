#include "core/planners/python_spec.hpp"

#include <gtest/gtest.h>

#include "core/math/random_stream.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

TEST(PythonSpec, ReadsFileClassAndParameters) {
  EXPECT_EQ(python_spec("py:a.py"), (PythonSpec{"a.py", "", ""}));
  EXPECT_EQ(python_spec("py:dir.d/a.py:Orbit"), (PythonSpec{"dir.d/a.py", "Orbit", ""}));
  EXPECT_EQ(python_spec("py:a.py:x=1,y=2"), (PythonSpec{"a.py", "", "x=1,y=2"}));
  EXPECT_EQ(python_spec("py:a.py:Orbit:x=1,y=b:c"), (PythonSpec{"a.py", "Orbit", "x=1,y=b:c"}));
  EXPECT_EQ(python_spec("py:a.py:params.yaml"), (PythonSpec{"a.py", "", "params.yaml"}));
  EXPECT_EQ(python_spec("py:a.py:_2:b/params.yaml"), (PythonSpec{"a.py", "_2", "b/params.yaml"}));
  for (const char* other : {"hover", "hover:py:a.py", "exec:py:a.py", "py", "python:a.py"}) {
    EXPECT_EQ(python_spec(other), std::nullopt) << other;
  }
  EXPECT_THROW(python_spec("py:"), InputError);
  EXPECT_THROW(python_spec("py::Orbit"), InputError);
}

TEST(PythonSpec, WithoutFoldersRemovesTheFoldersOfTheFile) {
  EXPECT_EQ(without_folders("py:/a/b.py:C:x=/d/e"), "py:b.py:C:x=/d/e");
  for (const char* other : {"kios:file=/a/b", "py:", "py:b.py", "exec:/a/b"}) EXPECT_EQ(without_folders(other), other);
}

TEST(PythonSpec, AWrittenSpecReadsBackTheSame) {
  RandomStream random(7, "python specs", 0);
  const auto one_of = [&](const std::vector<std::string>& texts) { return texts[random.bits() % texts.size()]; };
  for (int i = 0; i < 300; ++i) {
    const PythonSpec spec{one_of({"a.py", "/b/c.py", "d e.py", "f=g.py", "/e: f/g.py"}), one_of({"", "A", "_b", "C9"}),
                          one_of({"", "x=1", "x=1,y=a:b", "p.yaml", "/q/r.yaml", "x=,y=@"})};
    EXPECT_EQ(python_spec(text_of(spec)), spec) << text_of(spec);
  }
}

}  // namespace
}  // namespace skein
