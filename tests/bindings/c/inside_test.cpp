// What a program in C cannot bring about: structs that have grown, exceptions of any type.
#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <vector>

#include "host/active/scout.h"
#include "host/bindings/c/src/handles.h"
#include "host/bindings/c/src/structs.h"
#include "kernels/error.h"

namespace edgescout::c {

namespace {

// A struct that had two fields, then three.
struct Grown {
  std::size_t struct_size;
  double first, second, third;
};

}  // namespace

template <>
inline constexpr std::initializer_list<std::size_t> earlier_sizes<Grown>{offsetof(Grown, second),
                                                                         offsetof(Grown, third)};

namespace {

edgescout_status status_of(const std::function<void()>& work) { return guarded(work); }

TEST(CStructs, TakeThoseOfEarlierHeaders) {
  Grown older{offsetof(Grown, third), 1, 2, 3};
  Grown read = read_struct(&older, "older");
  EXPECT_EQ(read.second, 2);
  EXPECT_EQ(read.third, 0);  // not part of it, whatever lies there
  older.struct_size = offsetof(Grown, second);
  read = read_struct(&older, "older");
  EXPECT_EQ(read.first, 1);
  EXPECT_EQ(read.second, 0);
  older.struct_size = offsetof(Grown, second) + 4;  // ends inside a field
  EXPECT_EQ(status_of([&] { read_struct(&older, "older"); }), EDGESCOUT_WRONG_VERSION);
  EXPECT_STREQ(edgescout_last_error(),
               "older.struct_size: found 20, expected the struct's size, which is 32 in "
               "version " EDGESCOUT_VERSION);
}

TEST(CStructs, FillThoseOfEarlierHeaders) {
  std::vector<Grown> room{{offsetof(Grown, second), 7, 8, 9}, {}};
  write_struct(Grown{0, 1, 2, 3}, room.data(), "older");
  EXPECT_EQ(room[0].first, 1);
  EXPECT_EQ(room[0].second, 8);  // beyond its size
  EXPECT_EQ(room[0].struct_size, offsetof(Grown, second));
}

TEST(CErrors, EveryExceptionEndsAsAStatus) {
  EXPECT_EQ(status_of([] { throw InputError("f", "x", "1", "2"); }), EDGESCOUT_BAD_INPUT);
  EXPECT_STREQ(edgescout_last_error(), "f: x: found 1, expected 2");
  EXPECT_EQ(status_of([] { throw GpuError("lost"); }), EDGESCOUT_DEVICE);
  EXPECT_EQ(status_of([] { throw Cancelled(); }), EDGESCOUT_CANCELLED);
  EXPECT_EQ(status_of([] { throw std::bad_alloc(); }), EDGESCOUT_OUT_OF_MEMORY);
  EXPECT_EQ(status_of([] { throw LogicError("a\nb"); }), EDGESCOUT_INTERNAL);
  EXPECT_STREQ(edgescout_last_error(), "a b");
  EXPECT_EQ(status_of([] { throw 42; }), EDGESCOUT_INTERNAL);
  EXPECT_STREQ(edgescout_last_error(), "an exception of an unknown type");
  EXPECT_EQ(status_of([] {}), EDGESCOUT_OK);
}

struct Counted : Resource {
  const char* kind() const override { return "counted"; }
};

TEST(CHandles, AreReadBySeveralAndChangedByOne) {
  Counted counted;
  EXPECT_TRUE(counted.begin(Use::Shared));
  EXPECT_TRUE(counted.begin(Use::Shared));
  EXPECT_FALSE(counted.begin(Use::Exclusive));
  counted.end(Use::Shared);
  EXPECT_FALSE(counted.begin(Use::Exclusive));
  counted.end(Use::Shared);
  EXPECT_TRUE(counted.begin(Use::Exclusive));
  EXPECT_FALSE(counted.begin(Use::Shared));
  EXPECT_FALSE(counted.begin(Use::Exclusive));
  counted.end(Use::Exclusive);
  EXPECT_TRUE(counted.begin(Use::Shared));
}

TEST(CHandles, AreNeverTheSameAgain) {
  const void* const first = add_resource(std::make_shared<Counted>());
  free_handle(first);
  const void* const second = add_resource(std::make_shared<Counted>());
  EXPECT_NE(first, second);
  EXPECT_EQ(edgescout_free(first), EDGESCOUT_BAD_HANDLE);
  EXPECT_EQ(edgescout_free(second), EDGESCOUT_OK);
  EXPECT_EQ(edgescout_handle_count(), 0u);
}

}  // namespace

}  // namespace edgescout::c
