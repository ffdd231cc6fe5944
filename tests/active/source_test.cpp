#include "host/active/source.h"

#include <gtest/gtest.h>

#include "tests/active/tiny_scene.h"

namespace edgescout::test {
namespace {

TEST(CallbackSource, CallsBack) {
  int asked = -1;
  CallbackSource source(tiny_scene().views[0].camera, {Se3{}, Se3{}}, [&](int view) -> Shot {
    asked = view;
    throw AcquisitionError("the arm is stuck");
  });
  EXPECT_EQ(source.views().size(), 2u);
  EXPECT_EQ(source.camera().width, 160);
  EXPECT_THROW(source.acquire(1), AcquisitionError);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace edgescout::test
