#define BOOST_TEST_MODULE sphverify
#include <boost/test/unit_test.hpp>
